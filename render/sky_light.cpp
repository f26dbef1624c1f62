#include "render/sky_light.h"

#include <cmath>

#include "render/colour.h"
#include "render/night/night_floor.h"

namespace skyig::render {

namespace {

glm::vec3 xyz_of(const LitAir& lit, double elevation_rad, double azimuth_rad, Side side) {
    if (lit.view == nullptr) return glm::vec3{0.0F};
    const auto elevation = static_cast<float>(elevation_rad);
    const auto azimuth = static_cast<float>(azimuth_rad - lit.azimuth_rad);
    switch (side) {
        case Side::kSky:
            return lit.scale_xyz * lit.view->xyz_above(elevation, azimuth);
        case Side::kGround:
            return lit.scale_xyz * lit.view->xyz_below(elevation, azimuth);
        case Side::kByElevation:
            break;
    }
    return lit.scale_xyz * lit.view->xyz(elevation, azimuth);
}

}  // namespace

glm::vec3 SkyLight::rgb_cd_m2(double elevation_rad, double azimuth_rad, Side side) const noexcept {
    const bool ground =
        side == Side::kGround || (side == Side::kByElevation && elevation_rad < horizon_elevation_rad);
    const glm::vec3 floor =
        night::night_floor_xyz(elevation_rad, horizon_elevation_rad, eye_height_m, ground);
    return rec709_from_xyz(xyz_of(sun, elevation_rad, azimuth_rad, side) +
                           xyz_of(moon, elevation_rad, azimuth_rad, side) + floor);
}

Horizontal horizontal_of(const glm::dvec3& d) noexcept {
    const double level = std::hypot(d.x, d.y);
    return {std::atan2(d.z, level), level > 0.0 ? std::atan2(d.x, d.y) : 0.0};
}

glm::dvec3 direction_of(const Horizontal& h) noexcept {
    const double level = std::cos(h.elevation_rad);
    return {level * std::sin(h.azimuth_rad), level * std::cos(h.azimuth_rad), std::sin(h.elevation_rad)};
}

}  // namespace skyig::render
