#include "render/eye/exposure.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::eye {

int exposure_exponent(Target target, double adaptation_cd_m2) noexcept {
    if (target != Target::kHalfLuminance) return -20;
    constexpr double kDarkest_cd_m2 = 1e-6;
    constexpr double kBrightest_cd_m2 = 1e10;
    const double adaptation = std::clamp(adaptation_cd_m2, kDarkest_cd_m2, kBrightest_cd_m2);
    return -9 - static_cast<int>(std::floor(std::log2(adaptation)));
}

shaders64::ToneParameters luminance_parameters(int exposure_exponent) noexcept {
    shaders64::ToneParameters tone{};
    tone.log2_gain = exposure_exponent;
    tone.exponent = 1.0;
    tone.photopic = 1.0;
    tone.point_gain = std::exp2(exposure_exponent);
    tone.inv_display_max = 1.0;
    tone.shoulder = 1.0;
    tone.encode_power = -2.0;
    return tone;
}

}  // namespace skyig::render::eye
