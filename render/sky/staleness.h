// When a table of directions no longer serves the eye.
#pragma once

#include <algorithm>
#include <cmath>

namespace skyig::render::sky {

/// Heights above the ground, metres: what a step of 2 m, or of 0.5 % high up, changes is not seen.
[[nodiscard]] inline bool height_is_stale(double now_m, double held_m) noexcept {
    return std::abs(now_m - held_m) > std::max(2.0, 0.005 * (std::abs(held_m) + 100.0));
}

}  // namespace skyig::render::sky
