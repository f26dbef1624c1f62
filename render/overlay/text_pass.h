// Draws short texts over a picture in one pass; blended by coverage.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/overlay/overlay.h"

namespace skyig::render {

struct TextStyle {
    /// Of the font's pixels, 1..kMaxTextScale.
    int scale = 2;
    /// Display codes, 0..1.
    glm::vec3 colour{1.0F};
    /// How much of what lies behind the text's cells is blackened, 0..1.
    float shade = 0.6F;
};

class TextPass {
  public:
    /// Texts of one picture hold so many glyphs at most; what is more is left out.
    static constexpr std::size_t kMaxGlyphs = 2048;

    /// \throws std::runtime_error when the program cannot be made
    TextPass();

    void clear() noexcept { glyphs_.clear(); }
    /// \param left_px, top_px  of the first glyph in the picture, from its upper left corner
    void add(std::string_view text, int left_px, int top_px, const TextStyle& style);
    /// All texts since clear(), onto a bound picture of that size.
    void draw(int width_px, int height_px);

  private:
    /// As overlay/text.vert takes it.
    struct Vertex {
        glm::vec2 middle_px;
        float size_px = 0.0F;
        glm::vec2 rows;
        glm::vec4 colour_shade;
    };

    gl::Program program_;
    gl::Mesh points_;
    int size_;
    std::vector<Vertex> glyphs_;
};

}  // namespace skyig::render
