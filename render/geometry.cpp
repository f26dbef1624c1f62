#include "render/geometry.h"

#include <algorithm>
#include <cmath>

namespace skyig::render {

double horizon_elevation_rad(double eye_height_m) noexcept {
    const double h = std::max(eye_height_m, 0.0);
    return -std::atan2(std::sqrt(h * (2.0 * kEarthRadius_m + h)), kEarthRadius_m);
}

double straight_elevation_rad(double seen_rad, double seen_horizon_rad,
                              double straight_horizon_rad) noexcept {
    if (seen_rad >= 0.0 || seen_horizon_rad >= 0.0) return seen_rad;
    if (seen_rad >= seen_horizon_rad) return seen_rad * (straight_horizon_rad / seen_horizon_rad);
    const double shift_rad = straight_horizon_rad - seen_horizon_rad;
    return seen_rad + shift_rad * std::tan(seen_horizon_rad) * std::cos(seen_rad) / std::sin(seen_rad);
}

Horizontal horizontal_of(const glm::dvec3& d) noexcept {
    const double level = std::hypot(d.x, d.y);
    return {std::atan2(d.z, level), level > 0.0 ? std::atan2(d.x, d.y) : 0.0};
}

glm::dvec3 direction_of(const Horizontal& h) noexcept {
    const double level = std::cos(h.elevation_rad);
    return {level * std::sin(h.azimuth_rad), level * std::cos(h.azimuth_rad), std::sin(h.elevation_rad)};
}

glm::dmat3 enu_from_equatorial(double latitude_rad, double sidereal_rad) noexcept {
    const double c = std::cos(sidereal_rad);
    const double s = std::sin(sidereal_rad);
    const double level = std::cos(latitude_rad);
    const double rise = std::sin(latitude_rad);
    const glm::dvec3 east{-s, c, 0.0};
    const glm::dvec3 north{-rise * c, -rise * s, level};
    const glm::dvec3 up{level * c, level * s, rise};
    return glm::transpose(glm::dmat3{east, north, up});
}

double smooth_step(double low, double high, double x) noexcept {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace skyig::render
