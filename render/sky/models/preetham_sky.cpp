#include "render/sky/models/preetham_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sky/azimuth.h"

namespace skyig::render::sky::models {

void PreethamSky::begin(const PreethamSettings& settings, const AirTables& tables, double eye_height_m,
                        double source_elevation_rad) noexcept {
    at_ = Surroundings(tables, eye_height_m, source_elevation_rad);
    const double t = std::clamp(settings.turbidity.value_or(turbidity_of(tables.model())), kLeastTurbidity,
                                kMostTurbidity);
    const double sun_zenith =
        0.5 * std::numbers::pi - std::max(at_.source_elevation_rad(), kLowestFormulaSun_rad);
    const double printed = shaders64::preetham_zenith_luminance(t, sun_zenith) * at_.air_above() *
                           at_.fade_below(tables, kLowestFormulaSun_rad);
    const double zenith_cd_m2 = settings.zenith_of_multi ? static_cast<double>(at_.zenith_xyz().y) : printed;
    const glm::dvec2 zenith_xy = settings.zenith_of_multi
                                     ? chromaticity_of(at_.zenith_xyz())
                                     : glm::dvec2{shaders64::preetham_zenith_x(t, sun_zenith),
                                                  shaders64::preetham_zenith_y(t, sun_zenith)};
    colour_ = PerezColour(t, sun_zenith, zenith_xy);
    sky_ = shaders32::preetham_luminance(static_cast<float>(t));
    scale_ = static_cast<float>(zenith_cd_m2) / shaders32::perez(1.0F, static_cast<float>(sun_zenith), sky_);
}

glm::vec3 PreethamSky::xyz_above(float elevation_rad, float relative_azimuth_rad) const noexcept {
    if (!std::isfinite(elevation_rad) || !std::isfinite(relative_azimuth_rad)) return glm::vec3(0.0F);
    const float elevation = clamped_above(at_, elevation_rad);
    const float sine = std::sin(elevation);
    const float sun_angle = shaders32::angle_between(
        elevation, static_cast<float>(at_.source_elevation_rad()), folded_azimuth(relative_azimuth_rad));
    return colour_.xyz(scale_ * shaders32::perez(sine, sun_angle, sky_), sine, sun_angle);
}

glm::vec3 PreethamSky::xyz_below(float elevation_rad, float relative_azimuth_rad) const noexcept {
    if (!std::isfinite(elevation_rad) || !std::isfinite(relative_azimuth_rad)) return glm::vec3(0.0F);
    return hazy_ground(at_, clamped_below(at_, elevation_rad),
                       xyz_above(static_cast<float>(at_.horizon_elevation_rad()), relative_azimuth_rad));
}

}  // namespace skyig::render::sky::models
