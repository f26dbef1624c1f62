// Scenes made by hand for the renderer's tests: no ephemeris, no host.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "render/channel.h"
#include "render/scene.h"
#include "render/sky/refraction.h"
#include "render/sky_light.h"

namespace skyig::render::tests {

inline constexpr double kDegree = std::numbers::pi / 180.0;

struct NamedScene {
    std::string name;
    Scene scene;
};

inline glm::dvec3 at(double elevation_deg, double azimuth_deg) {
    return direction_of({elevation_deg * kDegree, azimuth_deg * kDegree});
}

/// Axes of a Moon that shows the middle of its near side, its north towards the zenith (in the zenith:
/// towards north).
inline glm::dmat3 moon_upright(const glm::dvec3& direction_enu) {
    const glm::dvec3 up =
        std::abs(direction_enu.z) < 0.999 ? glm::dvec3{0.0, 0.0, 1.0} : glm::dvec3{0.0, 1.0, 0.0};
    const glm::dvec3 east = glm::normalize(glm::cross(up, -direction_enu));
    return {-direction_enu, east, glm::cross(-direction_enu, east)};
}

/// A scene with the Sun and the Moon where they are asked for. Stars lie turned somehow, the same in every
/// scene.
inline Scene make_scene(double sun_elevation_deg, double sun_azimuth_deg, double moon_elevation_deg,
                        double moon_azimuth_deg, double height_m) {
    Scene scene;
    scene.eye.height_m = height_m;
    scene.sun.direction_enu = at(sun_elevation_deg, sun_azimuth_deg);
    scene.moon.direction_enu = at(moon_elevation_deg, moon_azimuth_deg);
    scene.moon.enu_from_selenographic = moon_upright(scene.moon.direction_enu);
    scene.moon.to_sun_enu = scene.sun.direction_enu;
    const double cosine = -glm::dot(scene.moon.direction_enu, scene.sun.direction_enu);
    scene.moon.phase_angle_rad =
        std::atan2(glm::length(glm::cross(scene.moon.direction_enu, scene.sun.direction_enu)), cosine);
    const glm::dvec3 x = glm::normalize(glm::dvec3{0.3, 0.8, 0.52});
    const glm::dvec3 y = glm::normalize(glm::cross(glm::dvec3{0.1, -0.2, 0.97}, x));
    scene.stars.enu_from_gcrs = glm::dmat3{x, y, glm::cross(x, y)};
    return scene;
}

inline sky::RefractionRow refraction_of(const Scene& scene) {
    static const sky::Refraction refraction;
    return refraction.at(scene.eye.height_m, scene.air.model_enabled ? scene.air.pressure_hpa : 0.0,
                         scene.air.temperature_c);
}

/// Where the scene's air shows what stands at a direction without air.
inline glm::dvec3 seen(const Scene& scene, const glm::dvec3& direction_enu) {
    const Horizontal airless = horizontal_of(direction_enu);
    return direction_of(
        {refraction_of(scene).apparent_from_true(airless.elevation_rad), airless.azimuth_rad});
}

/// The four times of day that a seam or a colour must hold at.
inline std::vector<NamedScene> four_times() {
    return {{"dawn", make_scene(1.5, 120.0, -30.0, 300.0, 400.0)},
            {"noon", make_scene(48.0, 185.0, -10.0, 40.0, 1500.0)},
            {"dusk", make_scene(-5.0, 235.0, 12.0, 100.0, 300.0)},
            {"night", make_scene(-35.0, 0.0, 38.0, 170.0, 600.0)}};
}

/// Puts a sea with a breeze and four told trains of waves below a scene.
inline void add_waves(Scene& scene) {
    scene.ground.kind = Ground::Kind::kSea;
    scene.ground.wind_m_s = 5.0;
    scene.ground.wind_from_rad = 0.5;
    const Wave swell{.height_m = 2.0, .length_m = 110.0, .period_s = 8.4, .direction_rad = 0.9};
    const Wave sea{.height_m = 1.0,
                   .length_m = 60.0,
                   .period_s = 6.2,
                   .direction_rad = 1.4,
                   .phase_rad = 1.0,
                   .leading_rad = 0.3};
    const Wave chop{.height_m = 0.5, .length_m = 27.0, .period_s = 4.2, .direction_rad = 0.5};
    const Wave ripple{.height_m = 0.3, .length_m = 14.0, .period_s = 3.0, .direction_rad = 1.9};
    for (const Wave& wave : {chop, swell, sea, ripple})
        scene.sea.waves[scene.sea.wave_count++] = wave;
}

/// Looks along an azimuth, pitched and rolled as an ownship would be.
inline glm::dmat3 view_from_enu(double yaw_deg, double pitch_deg, double roll_deg,
                                double view_yaw_deg = 0.0) {
    return view_from_body() * body_from_ned(view_yaw_deg * kDegree, 0.0, 0.0) *
           body_from_ned(yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree) * ned_from_enu();
}

inline Frustum symmetric_frustum(double half_width_deg, int width_px, int height_px) {
    const double half_height = std::atan(std::tan(half_width_deg * kDegree) * height_px / width_px);
    return {-half_width_deg * kDegree, half_width_deg * kDegree, -half_height, half_height};
}

inline void add_view(Scene& scene, const Frustum& frustum, const glm::dmat3& view) {
    scene.views[scene.view_count++] = {frustum, view};
}

}  // namespace skyig::render::tests
