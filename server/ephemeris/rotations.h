// Rotations of axes about one of them.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace skyig::server::ephemeris {

/// Coordinates in axes that are turned about x by `angle_rad` (y towards z) from coordinates in the unturned
/// ones. The inverse is the rotation by the negative angle.
[[nodiscard]] inline glm::dmat3 rotation_about_x(double angle_rad) noexcept {
    const double s = std::sin(angle_rad);
    const double c = std::cos(angle_rad);
    return {1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c};
}

/// The same about z (x towards y).
[[nodiscard]] inline glm::dmat3 rotation_about_z(double angle_rad) noexcept {
    const double s = std::sin(angle_rad);
    const double c = std::cos(angle_rad);
    return {c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0};
}

}  // namespace skyig::server::ephemeris
