// When a table of directions no longer serves the eye.
#pragma once

#include <algorithm>
#include <cmath>

namespace skyig::render::sky {

/// How far the eye may be from the height that a table was made for, metres: about a display code at the
/// horizon, a third of one elsewhere.
[[nodiscard]] inline double height_step_m(double height_m) noexcept {
    return std::max(2.0, 0.008 * (std::abs(height_m) + 100.0));
}

[[nodiscard]] inline bool height_is_stale(double now_m, double held_m) noexcept {
    return std::abs(now_m - held_m) > height_step_m(held_m);
}

/// How far a source may be from the elevation that a table was made for: 1 % of luminance in the steepest
/// twilight; by day a fifth of a display code.
[[nodiscard]] inline double source_step_rad(double elevation_rad) noexcept {
    constexpr double kDegree = 0.017453292519943295;
    const double day = std::clamp((elevation_rad / kDegree - 5.0) / 10.0, 0.0, 1.0);
    return (0.01 + 0.02 * day) * kDegree;
}

}  // namespace skyig::render::sky
