#include "clients/skyig/sky/night_solver.h"

#include <cmath>

#include "render/colour.h"
#include "render/geometry.h"
#include "render/light_tables.h"
#include "render/night/moon_light.h"

namespace skyig::clients::sky {

namespace {

using render::direction_of;

glm::dmat3 turned(double azimuth_rad) {
    const double c = std::cos(azimuth_rad);
    const double s = std::sin(azimuth_rad);
    // Brings what stands at that azimuth to north.
    return {glm::dvec3{c, s, 0.0}, glm::dvec3{-s, c, 0.0}, glm::dvec3{0.0, 0.0, 1.0}};
}

}  // namespace

NightSolver::NightSolver(const Atmosphere& atmosphere, const std::optional<MoonPlace>& moon,
                         const std::optional<RealSky>& real)
    : moon_(moon), tables_(atmosphere.air, render::sky::models::orders_of(atmosphere.sky.model)) {
    scene_.sky = atmosphere.sky;
    scene_.night = atmosphere.night;
    scene_.moon.direction_enu = {0.0, 0.0, -1.0};
    if (moon_) {
        scene_.moon.direction_enu =
            direction_of({glm::radians(moon_->elevation_deg), glm::radians(moon_->rel_azimuth_deg)});
        scene_.moon.phase_angle_rad = glm::radians(moon_->phase_angle_deg);
    }
    dark_scene_ = scene_;
    if (real) {
        const glm::dmat3 turn = turned(render::horizontal_of(real->sun_enu).azimuth_rad);
        dark_scene_.stars.enu_from_gcrs = turn * real->enu_from_gcrs;
        dark_scene_.sun.direction_enu = turn * real->sun_enu;
        dark_scene_.eye.latitude_deg = real->latitude_deg;
        dark_scene_.eye.longitude_deg = real->longitude_deg;
        milky_way_.begin(atmosphere.night.structure, atmosphere.night.seed);
        milky_way_.build_rows(render::night::MilkyWayMap::kHeight);
    } else {
        dark_scene_.night.city_count = 0;
        if (dark_scene_.night.model == render::NightModel::kSources)
            dark_scene_.night.model = render::NightModel::kMean;
    }
}

void NightSolver::begin(double altitude_m, double sun_zenith_deg) {
    scene_.eye.height_m = dark_scene_.eye.height_m = altitude_m;
    scene_.sun.direction_enu = direction_of({glm::radians(90.0 - sun_zenith_deg), 0.0});
    const render::Plan plan = render::make_plan(scene_, {}, {});
    light_ = {};
    light_.eye_height_m = altitude_m;
    light_.straight_horizon_rad = light_.horizon_elevation_rad = render::horizon_elevation_rad(altitude_m);
    light_.ground_albedo = render::sky::luminous_albedo(tables_.model(), tables_.model().ground_albedo);
    light_by_sun_and_moon(plan);
    if (!(plan.night_share > 0.0)) return;
    night_sky_.build(dark_scene_, tables_);
    light_.night = &night_sky_;
    light_.night_share = static_cast<float>(plan.night_share);
    if (!milky_way_.complete() || dark_scene_.night.model != render::NightModel::kSources) return;
    light_.milky_way = render::lit_belt(dark_scene_, milky_way_, plan.night_share);
}

void NightSolver::light_by_sun_and_moon(const render::Plan& plan) {
    const double height_m = scene_.eye.height_m;
    if (plan.sun_share > 0.0) {
        const render::Horizontal sun = render::horizontal_of(scene_.sun.direction_enu);
        sun_sky_.begin(scene_.sky, tables_, height_m, sun.elevation_rad, true);
        sun_sky_.build_all();
        light_.sun = {&sun_sky_, sun, glm::vec3{static_cast<float>(plan.sun_share)}, nullptr, {}, 1.0F};
    }
    if (!moon_ || !(plan.moon_share > 0.0)) return;
    const render::Horizontal moon = render::horizontal_of(scene_.moon.direction_enu);
    moon_sky_.begin(scene_.sky, tables_, height_m, moon.elevation_rad, false);
    moon_sky_.build_all();
    light_.moon = {&moon_sky_, moon, render::moon_scale_xyz(scene_, tables_.model(), plan.moon_share),
                   nullptr,    {},   1.0F};
}

glm::dvec3 NightSolver::xyz(double view_zenith_deg, double rel_azimuth_deg) {
    const glm::vec3 rgb = light_.rgb_cd_m2(glm::radians(90.0 - view_zenith_deg),
                                           glm::radians(rel_azimuth_deg), render::Side::kByElevation);
    return glm::max(glm::dvec3{render::xyz_from_rec709(rgb)}, glm::dvec3{0.0});
}

}  // namespace skyig::clients::sky
