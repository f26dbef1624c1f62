// The tone curve as the driver computes it: grey luminances go through the text that draws the picture, into
// floats.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/discs.h"
#include "render/gl/float_target.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"

namespace skyig::render {

/// What a grey luminance is shown as.
struct ShownGrey {
    /// Asked of the display; may be more than it can show, or less than its black.
    double display_cd_m2 = 0.0;
    /// Display code 0..1, before dither and rounding.
    double n = 0.0;
};

/// Needs a current OpenGL 4.5 core context for its whole life.
class ToneProbe {
  public:
    /// \throws std::runtime_error with the GL text
    ToneProbe();

    /// \param luminance_cd_m2  any floats at all; \param shown  as many
    void measure(std::span<const float> luminance_cd_m2, const shaders32::ToneParameters& tone,
                 std::span<ShownGrey> shown);

    /// Greys that one draw takes.
    static constexpr int kWidth = 1024;

  private:
    gl::Program program_;
    ToneUniforms tone_;
    gl::Mesh triangle_;
    gl::Texture light_;
    gl::FloatTarget target_;
    std::vector<float> texels_;
    std::vector<glm::vec4> pixels_;
};

}  // namespace skyig::render
