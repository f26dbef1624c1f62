#include "render/overlay/text_pass.h"

#include <algorithm>
#include <span>

#include "render/overlay/font.h"

namespace skyig::render {

TextPass::TextPass()
    : program_("overlay/text.vert", "overlay/text.frag"),
      points_({2, 1, 2, 4}, kMaxGlyphs),
      size_(program_.uniform("u_size_px")) {
    static_assert(sizeof(Vertex) == 9 * sizeof(float));
    glyphs_.reserve(kMaxGlyphs);
}

void TextPass::add(std::string_view text, int left_px, int top_px, const TextStyle& style) {
    const int scale = std::clamp(style.scale, 1, kMaxTextScale);
    const int half_px = scale * kGlyphRows / 2;
    int middle_px = left_px + half_px;
    for (const char character : text) {
        if (glyphs_.size() == kMaxGlyphs) return;
        const Glyph& rows = glyph(character);
        glyphs_.push_back({glm::vec2{middle_px, top_px + half_px}, static_cast<float>(2 * half_px),
                           glm::vec2{static_cast<float>(rows[0]), static_cast<float>(rows[1])},
                           glm::vec4{style.colour, style.shade}});
        middle_px += scale * kGlyphStep;
    }
}

void TextPass::draw(int width_px, int height_px) {
    if (glyphs_.empty()) return;
    points_.update(
        {reinterpret_cast<const float*>(glyphs_.data()), std::span(glyphs_).size_bytes() / sizeof(float)});
    program_.use();
    program_.set(size_, glm::vec2{width_px, height_px});
    points_.draw_points(glyphs_.size());
}

}  // namespace skyig::render
