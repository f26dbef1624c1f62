#include "render/still_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/geometry.h"
#include "render/shaders/shared.h"

namespace skyig::render {

namespace {

constexpr double kPi = std::numbers::pi;

double luminance_cd_m2(const SkyLight& light, double elevation_rad, double azimuth_rad) {
    return static_cast<double>(
        shaders32::luminance_709(light.rgb_cd_m2(elevation_rad, azimuth_rad, Side::kSky)));
}

}  // namespace

void StillLight::settle(const Scene& scene) {
    // A table that is only a little old is made anew in slices.
    constexpr int kFrames = 20;
    scene_ = scene;
    const sky::RefractionRow refraction = tables_.refraction(scene);
    Plan plan;
    for (int frame = 0; frame < kFrames; ++frame) {
        plan = make_plan(scene, tables_.held(scene), refraction);
        tables_.update(scene, plan);
    }
    light_ = tables_.light(scene, plan, refraction);
    if (!light_.night || scene.night.model != NightModel::kSources) return;
    milky_way_.make_map(scene.night, true);
    light_.milky_way = lit_belt(scene, milky_way_.map(), plan.night_share);
}

double StillLight::zenith_cd_m2() const noexcept {
    return luminance_cd_m2(light_, 0.5 * kPi, 0.0);
}

double StillLight::sky_lux() const noexcept {
    constexpr int kRings = 24;
    constexpr int kAround = 24;
    double sum = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double sine = (ring + 0.5) / kRings;
        for (int i = 0; i < kAround; ++i)
            sum += sine * luminance_cd_m2(light_, std::asin(sine), 2.0 * kPi * (i + 0.5) / kAround);
    }
    return 2.0 * kPi * sum / (kRings * kAround);
}

double StillLight::disc_lux(const glm::dvec3& direction_enu) const noexcept {
    const double seen_rad = light_.refraction.apparent_from_true(horizontal_of(direction_enu).elevation_rad);
    return air().direct_sun_xyz(scene_.eye.height_m, seen_rad).y * std::max(0.0, std::sin(seen_rad));
}

double StillLight::sun_lux() const noexcept {
    return scene_.sun.unobscured / (scene_.sun.distance_au * scene_.sun.distance_au) *
           disc_lux(scene_.sun.direction_enu);
}

double StillLight::moon_lux() const noexcept {
    return static_cast<double>(moon_scale_xyz(scene_, air().model(), 1.0).y) *
           disc_lux(scene_.moon.direction_enu);
}

}  // namespace skyig::render
