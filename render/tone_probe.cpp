#include "render/tone_probe.h"

#include <algorithm>

#include "render/gl/draw.h"

namespace skyig::render {

ToneProbe::ToneProbe()
    : program_("common/write.vert", "eye/curve.frag"),
      tone_(program_, true),
      triangle_({}, 3),
      light_(gl::TexelFormat::kR32F, kWidth, 1),
      target_(kWidth, 1),
      texels_(kWidth),
      pixels_(kWidth) {}

void ToneProbe::measure(std::span<const float> luminance_cd_m2, const shaders32::ToneParameters& tone,
                        std::span<ShownGrey> shown) {
    tone_.set(program_, tone);
    gl::set_common_state();
    gl::set_blend(gl::Blend::kReplace);
    for (std::size_t first = 0; first < luminance_cd_m2.size(); first += texels_.size()) {
        const auto part =
            luminance_cd_m2.subspan(first, std::min(texels_.size(), luminance_cd_m2.size() - first));
        std::copy(part.begin(), part.end(), texels_.begin());
        light_.update(texels_);
        target_.bind();
        program_.use();
        gl::bind_texture(0, light_.name());
        triangle_.draw_strip(3);
        target_.read_row(pixels_);
        for (std::size_t i = 0; i < part.size(); ++i)
            shown[first + i] = {static_cast<double>(pixels_[i].x), static_cast<double>(pixels_[i].y)};
    }
}

}  // namespace skyig::render
