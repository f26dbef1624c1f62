#include "render/sky/models/windlight_sky.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/colour.h"
#include "render/sky/azimuth.h"

namespace skyig::render::sky::models {
namespace {

constexpr double kLowestDaySun_rad = glm::radians(10.0);

}  // namespace

void WindlightSky::begin(const WindlightSettings& settings, const AirTables& tables, double eye_height_m,
                         double source_elevation_rad) noexcept {
    at_ = Surroundings(tables, eye_height_m, source_elevation_rad);
    haze_ = {glm::vec3(settings.blue_density),
             static_cast<float>(settings.haze_density),
             static_cast<float>(settings.density_per_m * at_.air_above()),
             static_cast<float>(settings.max_altitude_m),
             glm::vec3(settings.blue_horizon),
             static_cast<float>(settings.haze_horizon),
             glm::vec3(settings.sunlight),
             glm::vec3(settings.ambient),
             static_cast<float>(settings.glow_size),
             static_cast<float>(settings.glow_floor),
             static_cast<float>(settings.glow_power),
             static_cast<float>(settings.horizon_drop)};
    unit_cd_m2_ = static_cast<float>(settings.unit_cd_m2 * at_.fade_below(tables, kLowestDaySun_rad));
}

WindlightBetween WindlightSky::between(float elevation_rad, float relative_azimuth_rad,
                                       float distance_m) const noexcept {
    if (!std::isfinite(elevation_rad) || !std::isfinite(relative_azimuth_rad) || std::isnan(distance_m))
        return {};
    const auto sun = static_cast<float>(at_.source_elevation_rad());
    const float sun_angle =
        shaders32::angle_between(elevation_rad, sun, folded_azimuth(relative_azimuth_rad));
    const shaders32::WindlightAir air = shaders32::windlight_air(
        std::sin(elevation_rad), std::sin(sun), sun_angle, std::max(distance_m, 0.0F), haze_);
    return {air.passed, xyz_from_rec709(air.added * unit_cd_m2_)};
}

glm::vec3 WindlightSky::xyz_above(float elevation_rad, float relative_azimuth_rad) const noexcept {
    if (!std::isfinite(elevation_rad)) return glm::vec3(0.0F);
    return between(clamped_above(at_, elevation_rad), relative_azimuth_rad,
                   std::numeric_limits<float>::infinity())
        .added_xyz;
}

glm::vec3 WindlightSky::xyz_below(float elevation_rad, float relative_azimuth_rad) const noexcept {
    if (!std::isfinite(elevation_rad) || !std::isfinite(relative_azimuth_rad)) return glm::vec3(0.0F);
    const float elevation = clamped_below(at_, elevation_rad);
    const WindlightBetween haze =
        between(elevation, relative_azimuth_rad, static_cast<float>(at_.ground_distance_m(elevation)));
    const glm::vec3 ground = rec709_from_xyz(at_.ground_xyz());
    return glm::max(xyz_from_rec709(ground * haze.passed_rgb) + haze.added_xyz, glm::vec3(0.0F));
}

}  // namespace skyig::render::sky::models
