#include "render/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kEarthRadius_m = 6371e3;

// Below this the Sun adds less than a hundredth of the natural night.
constexpr double kSunGone_rad = -18.5 * kDegree;
// Moonlit air is lost in twilight while the Sun is above this.
constexpr double kMoonMatters_rad = -3.0 * kDegree;
// A source moves this far before its table is stale: 1 % of luminance in the steepest twilight.
constexpr double kStaleAngle_rad = 0.01 * kDegree;

double elevation_of(const glm::dvec3& direction) {
    return std::atan2(direction.z, std::hypot(direction.x, direction.y));
}

double horizon_of(double height_m) {
    const double h = std::max(height_m, 0.0);
    return -std::atan2(std::sqrt(h * (2.0 * kEarthRadius_m + h)), kEarthRadius_m);
}

bool height_is_stale(double now_m, double held_m) {
    return std::abs(now_m - held_m) > std::max(2.0, 0.005 * (std::abs(held_m) + 100.0));
}

// Faintest star that a practised eye sees against a background (Schaefer 1990, from Knoll et al.): V
// magnitude.
double faintest_visible_mag(double background_cd_m2) {
    const double nanolamberts = std::max(background_cd_m2, 0.0) / 3.1831e-6;
    const bool dark = nanolamberts <= 1500.0;
    const double c = std::pow(10.0, dark ? -9.80 : -8.35);
    const double k = std::pow(10.0, dark ? -1.90 : -5.90);
    const double root = 1.0 + std::sqrt(k * nanolamberts);
    return -16.57 - 2.5 * std::log10(c * root * root);
}

constexpr double kBrightestStar_mag = -1.46;
// Beyond the eye's limit a star still brightens its pixels by a fraction of a display code.
constexpr double kStarMargin_mag = 1.0;

PlannedPass plan_sky(Pass pass, bool lights, bool valid, double now_rad, double held_rad, bool height_stale) {
    if (!lights) return {pass, false, "the source is too low to light the air"};
    if (!valid) return {pass, true, "no table yet"};
    if (std::abs(now_rad - held_rad) > kStaleAngle_rad)
        return {pass, true, "the source has moved by 0.01 deg"};
    if (height_stale) return {pass, true, "the eye has changed height"};
    return {pass, false, "the table is fresh"};
}

}  // namespace

std::string_view pass_name(Pass pass) noexcept {
    constexpr std::array<std::string_view, kPassCount> kNames{"air tables", "sun sky",  "moon sky", "dome",
                                                              "stars",      "sun disc", "moon disc"};
    return kNames[static_cast<std::size_t>(pass)];
}

Plan make_plan(const Scene& scene, const Held& held) noexcept {
    Plan plan;
    const auto put = [&plan](const PlannedPass& pass) {
        plan.passes[static_cast<std::size_t>(pass.pass)] = pass;
    };
    const double sun_rad = elevation_of(scene.sun.direction_enu);
    const double moon_rad = elevation_of(scene.moon.direction_enu);
    const double horizon_rad = horizon_of(scene.eye.height_m);
    const bool air_stale = !held.air_valid || held.air != scene.air;
    put({Pass::kAirTables, air_stale, air_stale ? "the air is new" : "the air has not changed"});

    // From high up sources light air beyond the level horizon.
    plan.sun_lights_air = sun_rad > kSunGone_rad + horizon_rad;
    plan.moon_lights_air = sun_rad < kMoonMatters_rad && moon_rad > -6.0 * kDegree + horizon_rad;
    put(plan_sky(Pass::kSunSky, plan.sun_lights_air, held.sun_sky_valid, sun_rad, held.sun_sky_elevation_rad,
                 height_is_stale(scene.eye.height_m, held.sun_sky_height_m)));
    put(plan_sky(Pass::kMoonSky, plan.moon_lights_air, held.moon_sky_valid, moon_rad,
                 held.moon_sky_elevation_rad, height_is_stale(scene.eye.height_m, held.moon_sky_height_m)));
    put({Pass::kDome, true, "smooth light of all directions"});

    plan.star_limit_mag = faintest_visible_mag(held.background_cd_m2) + kStarMargin_mag;
    if (!scene.stars.enabled || scene.stars.intensity <= 0.0) {
        put({Pass::kStars, false, "switched off"});
    } else if (plan.star_limit_mag < kBrightestStar_mag) {
        put({Pass::kStars, false, "the sky outshines every star"});
    } else {
        put({Pass::kStars, true, "some stars outshine the sky"});
    }

    const auto disc = [&](Pass pass, bool enabled, double elevation_rad, double radius_rad) {
        if (!enabled) {
            put({pass, false, "switched off"});
        } else if (elevation_rad + 1.1 * radius_rad < horizon_rad) {
            put({pass, false, "below the horizon"});
        } else {
            put({pass, true, "above the horizon"});
        }
    };
    disc(Pass::kSunDisc, scene.sun.enabled, sun_rad, scene.sun.angular_radius_rad);
    disc(Pass::kMoonDisc, scene.moon.enabled, moon_rad, scene.moon.angular_radius_rad);
    return plan;
}

}  // namespace skyig::render
