#include "render/plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/geometry.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using tests::make_scene;

Held fresh(const Scene& scene) {
    Held held;
    held.air_valid = held.air_fresh = held.sun_sky_valid = held.moon_sky_valid = true;
    held.sun_sky_elevation_rad = horizontal_of(scene.sun.direction_enu).elevation_rad;
    held.moon_sky_elevation_rad = horizontal_of(scene.moon.direction_enu).elevation_rad;
    held.sun_sky_height_m = held.moon_sky_height_m = scene.eye.height_m;
    return held;
}

TEST(Plan, NothingHeldBuildsAirAndSky) {
    const Plan plan = make_plan(make_scene(30, 180, -20, 0, 1000), {});
    EXPECT_TRUE(plan.needs(Pass::kAirTables));
    EXPECT_TRUE(plan.needs(Pass::kSunSky));
    EXPECT_FALSE(plan.needs(Pass::kMoonSky));
    EXPECT_TRUE(plan.needs(Pass::kDome));
}

TEST(Plan, FreshTablesAreKept) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    const Plan plan = make_plan(scene, fresh(scene));
    EXPECT_FALSE(plan.needs(Pass::kAirTables));
    EXPECT_FALSE(plan.needs(Pass::kSunSky));
    EXPECT_EQ(plan.sun_share, 1.0);
}

TEST(Plan, SourceThatMovedAHundredthOfADegreeMakesItsTableStale) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Held held = fresh(scene);
    held.sun_sky_elevation_rad += 0.009 * tests::kDegree;
    EXPECT_FALSE(make_plan(scene, held).needs(Pass::kSunSky));
    held.sun_sky_elevation_rad += 0.002 * tests::kDegree;
    EXPECT_TRUE(make_plan(scene, held).needs(Pass::kSunSky));
}

TEST(Plan, StaleAirIsAskedForAnew) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Held held = fresh(scene);
    held.air_fresh = false;
    EXPECT_TRUE(make_plan(scene, held).needs(Pass::kAirTables));
    EXPECT_FALSE(make_plan(scene, held).needs(Pass::kSunSky))
        << "the table in use serves until the new air is there";
}

TEST(Plan, StarsGoBecauseTheSkyIsBrightNotBecauseTheSunIsUp) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Plan plan = make_plan(scene, fresh(scene));
    plan_stars(plan, scene, 2000.0);
    EXPECT_FALSE(plan.needs(Pass::kStars));
    plan_stars(plan, scene, 2e-4);  // the same Sun, seen from above the air
    EXPECT_TRUE(plan.needs(Pass::kStars));
    EXPECT_GT(plan.star_limit_mag, 7.5);
}

TEST(Plan, LimitingMagnitudeFollowsThePublishedTwilightRow) {
    // Zenith luminances and limits of the twilight row: sun -3, -6, -12 deg give 1.6, 3.6, 5.5 mag.
    for (const auto& [background, limit] :
         {std::pair{20.0, 1.6}, std::pair{0.6, 3.6}, std::pair{1.2e-3, 5.5}})
        EXPECT_NEAR(faintest_visible_mag(background), limit, 0.6) << background;
}

TEST(Plan, LimitingMagnitudeFallsSmoothlyFromNightToDay) {
    double last = faintest_visible_mag(1e-6);
    for (double log_b = -6.0; log_b < 5.0; log_b += 0.001) {
        const double now = faintest_visible_mag(std::pow(10.0, log_b));
        EXPECT_LE(now, last) << log_b;
        EXPECT_GT(now, last - 0.01) << log_b;
        last = now;
    }
}

TEST(Plan, MoonlightsTheAirOnlyByNight) {
    EXPECT_EQ(make_plan(make_scene(10, 0, 40, 180, 0), {}).moon_share, 0.0);
    EXPECT_EQ(make_plan(make_scene(-10, 0, 40, 180, 0), {}).moon_share, 1.0);
    EXPECT_EQ(make_plan(make_scene(-30, 0, -20, 180, 0), {}).moon_share, 0.0);
    EXPECT_EQ(make_plan(make_scene(-30, 0, -20, 180, 0), {}).sun_share, 0.0);
    // Its table is on the way before its light counts.
    const Plan before = make_plan(make_scene(-2.5, 0, 40, 180, 0), {});
    EXPECT_TRUE(before.needs(Pass::kMoonSky));
    EXPECT_EQ(before.moon_share, 0.0);
}

TEST(Plan, DiscsBelowTheDippedHorizonAreDropped) {
    EXPECT_FALSE(make_plan(make_scene(-1, 0, -40, 180, 0), {}).needs(Pass::kSunDisc));
    EXPECT_TRUE(make_plan(make_scene(-1, 0, -40, 180, 12000), {}).needs(Pass::kSunDisc));
    Scene off = make_scene(20, 0, 20, 180, 0);
    off.sun.enabled = false;
    EXPECT_EQ(make_plan(off, {})[Pass::kSunDisc].reason, "switched off");
}

TEST(Plan, EveryPassSaysWhy) {
    for (const auto& named : tests::four_times()) {
        Plan plan = make_plan(named.scene, {});
        plan_stars(plan, named.scene, 1.0);
        for (std::size_t i = 0; i < kPassCount; ++i) {
            EXPECT_EQ(static_cast<std::size_t>(plan.passes[i].pass), i);
            EXPECT_FALSE(plan.passes[i].reason.empty()) << pass_name(plan.passes[i].pass);
        }
    }
}

}  // namespace
}  // namespace skyig::render
