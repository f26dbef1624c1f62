#include "render/plan.h"

#include <algorithm>
#include <cmath>

#include "render/geometry.h"
#include "render/sky/staleness.h"

namespace skyig::render {

namespace {

constexpr double kDegree = glm::radians(1.0);

// A source moves this far before its table is stale: 1 % of luminance in the steepest twilight.
constexpr double kStaleAngle_rad = 0.01 * kDegree;

constexpr double kBrightestStar_mag = -1.46;
// Planets below this stand under the horizon wherever a cockpit may be; from higher up they only cost a pass.
constexpr double kLowestPlanet_sine = -0.1;
// Beyond the eye's limit a star still brightens its pixels by some codes: it fades out over the last 0.8 mag.
constexpr double kStarMargin_mag = 1.5;

double brightest_point_mag(const Scene& scene) {
    double brightest = kBrightestStar_mag;
    for (const Planet& planet : scene.planets) {
        if (planet.direction_enu.z > kLowestPlanet_sine) brightest = std::min(brightest, planet.magnitude);
    }
    return brightest;
}

// Part of the disc that is left when the corona begins to show and when it shows in full.
constexpr double kCoronaBegins = 0.02;
constexpr double kCoronaWhole = 0.002;

PlannedPass plan_sky(Pass pass, bool lights, bool valid, bool same_model, double now_rad, double held_rad,
                     bool height_stale) {
    if (!lights) return {pass, false, "the source is too low to light the air"};
    if (!valid) return {pass, true, "no table of this air yet"};
    if (!same_model) return {pass, true, "the sky's model, its parameters or the sea have changed"};
    if (std::abs(now_rad - held_rad) > kStaleAngle_rad)
        return {pass, true, "the source has moved by 0.01 deg"};
    if (height_stale) return {pass, true, "the eye has changed height"};
    return {pass, false, "the table is fresh"};
}

PlannedPass plan_disc(Pass pass, bool enabled, double elevation_rad, double radius_rad, double sets_at_rad) {
    if (!enabled) return {pass, false, "switched off"};
    if (elevation_rad + 1.1 * radius_rad < sets_at_rad) return {pass, false, "below the horizon"};
    return {pass, true, "above the horizon"};
}

void put(Plan& plan, const PlannedPass& pass) {
    plan.passes[static_cast<std::size_t>(pass.pass)] = pass;
}

}  // namespace

std::string_view pass_name(Pass pass) noexcept {
    constexpr std::array<std::string_view, kPassCount> kNames{
        "air tables", "sun sky", "moon sky", "dome", "stars", "corona", "sun disc", "moon disc"};
    return kNames[static_cast<std::size_t>(pass)];
}

double faintest_visible_mag(double background_cd_m2) noexcept {
    const double nanolamberts = std::max(background_cd_m2, 1e-9) / 3.1831e-6;
    const auto magnitude = [nanolamberts](double log_c, double log_k) {
        const double root = 1.0 + std::sqrt(std::pow(10.0, log_k) * nanolamberts);
        return -16.57 - 2.5 * (log_c + 2.0 * std::log10(root));
    };
    // Published as two branches with a step of 0.08 mag at 1500 nL; they cross close by, so the larger is
    // both smooth enough and right on either side.
    return std::max(magnitude(-9.80, -1.90), magnitude(-8.35, -5.90));
}

Plan make_plan(const Scene& scene, const Held& held, const sky::RefractionRow& refraction) noexcept {
    const double sets_at_rad = refraction.setting_elevation_rad();
    Plan plan;
    plan.sky_model = scene.sky.model;
    const double horizon_rad = horizon_elevation_rad(scene.eye.height_m);
    const double sun_rad = horizontal_of(scene.sun.direction_enu).elevation_rad;
    const double moon_rad = horizontal_of(scene.moon.direction_enu).elevation_rad;
    const bool air_stale = !held.air_valid || !held.air_fresh;
    put(plan, {Pass::kAirTables, air_stale, air_stale ? "the air is new" : "the air has not changed"});

    // Sunlit air ends at -21.5 deg (towards the Sun it outshines the night sky's low parts beyond -18),
    // moonlit air at -10 deg of the Moon and where twilight drowns it. From high up sources light air beyond
    // the level horizon.
    plan.sun_share = smooth_step(-21.5 * kDegree, -18.5 * kDegree, sun_rad - horizon_rad);
    plan.moon_share = smooth_step(-10.0 * kDegree, -6.0 * kDegree, moon_rad - horizon_rad) *
                      smooth_step(-3.0 * kDegree, -6.0 * kDegree, sun_rad);
    // The Moon's table is begun before its light counts.
    const bool moon_lights = moon_rad - horizon_rad > -10.5 * kDegree && sun_rad < -2.0 * kDegree;
    put(plan, plan_sky(Pass::kSunSky, plan.sun_share > 0.0, held.sun_sky_valid, held.sun_sky_model, sun_rad,
                       held.sun_sky_elevation_rad,
                       sky::height_is_stale(scene.eye.height_m, held.sun_sky_height_m)));
    put(plan, plan_sky(Pass::kMoonSky, moon_lights, held.moon_sky_valid, held.moon_sky_model, moon_rad,
                       held.moon_sky_elevation_rad,
                       sky::height_is_stale(scene.eye.height_m, held.moon_sky_height_m)));
    put(plan, {Pass::kDome, true, "smooth light of all directions"});
    put(plan, {Pass::kStars, false, "not decided yet"});
    plan.corona_share = smooth_step(kCoronaBegins, kCoronaWhole, scene.sun.unobscured);
    if (plan.corona_share > 0.0) {
        put(plan, plan_disc(Pass::kCorona, scene.sun.enabled, sun_rad, 8.0 * scene.sun.angular_radius_rad,
                            sets_at_rad));
    } else {
        put(plan, {Pass::kCorona, false, "the Sun outshines it"});
    }
    put(plan,
        plan_disc(Pass::kSunDisc, scene.sun.enabled, sun_rad, scene.sun.angular_radius_rad, sets_at_rad));
    put(plan,
        plan_disc(Pass::kMoonDisc, scene.moon.enabled, moon_rad, scene.moon.angular_radius_rad, sets_at_rad));
    return plan;
}

void plan_stars(Plan& plan, const Scene& scene, double background_cd_m2) noexcept {
    plan.star_limit_mag = faintest_visible_mag(background_cd_m2) + kStarMargin_mag;
    if (!scene.stars.enabled || scene.stars.intensity <= 0.0) {
        put(plan, {Pass::kStars, false, "switched off"});
    } else if (plan.star_limit_mag < brightest_point_mag(scene)) {
        put(plan, {Pass::kStars, false, "the sky outshines every star and planet"});
    } else {
        put(plan, {Pass::kStars, true, "some stars outshine the sky"});
    }
}

}  // namespace skyig::render
