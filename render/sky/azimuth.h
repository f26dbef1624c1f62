// Azimuths as tables and formulas that are symmetric about the light source take them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::render::sky {

/// Absolute azimuth in 0..pi of any finite angle. The exact remainder is slow and seldom needed.
[[nodiscard]] inline float folded_azimuth(float azimuth_rad) noexcept {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float size = std::abs(azimuth_rad);
    return size <= kPi ? size : std::min(std::abs(std::remainder(size, 2.0F * kPi)), kPi);
}

}  // namespace skyig::render::sky
