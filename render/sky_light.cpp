#include "render/sky_light.h"

#include <cmath>

#include "render/colour.h"
#include "render/night/night_floor.h"

namespace skyig::render {

namespace {

glm::vec3 xyz_of(const LitAir& lit, double above_horizon_rad, double azimuth_rad, bool ground) {
    if (lit.view == nullptr) return glm::vec3{0.0F};
    const auto elevation = static_cast<float>(lit.view->horizon_elevation_rad() + above_horizon_rad);
    const auto azimuth = static_cast<float>(azimuth_rad - lit.source.azimuth_rad);
    return lit.scale_xyz *
           (ground ? lit.view->xyz_below(elevation, azimuth) : lit.view->xyz_above(elevation, azimuth));
}

}  // namespace

double SkyLight::straight_elevation_rad(double elevation_rad) const noexcept {
    if (elevation_rad >= 0.0 || horizon_elevation_rad >= 0.0) return elevation_rad;
    if (elevation_rad >= horizon_elevation_rad)
        return elevation_rad * (straight_horizon_rad / horizon_elevation_rad);
    const double shift_rad = straight_horizon_rad - horizon_elevation_rad;
    return elevation_rad +
           shift_rad * std::tan(horizon_elevation_rad) * std::cos(elevation_rad) / std::sin(elevation_rad);
}

glm::vec3 SkyLight::rgb_cd_m2(double elevation_rad, double azimuth_rad, Side side) const noexcept {
    const double straight_rad = straight_elevation_rad(elevation_rad);
    const double above_rad = straight_rad - straight_horizon_rad;
    const bool ground =
        side == Side::kGround || (side == Side::kByElevation && elevation_rad < horizon_elevation_rad);
    return rec709_from_xyz(xyz_of(sun, above_rad, azimuth_rad, ground) +
                           xyz_of(moon, above_rad, azimuth_rad, ground) +
                           night::night_floor_xyz(straight_rad, straight_horizon_rad, eye_height_m, ground));
}

}  // namespace skyig::render
