#include "render/plan.h"

#include <gtest/gtest.h>

#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using tests::make_scene;

Held fresh(const Scene& scene) {
    Held held;
    held.air_valid = held.sun_sky_valid = held.moon_sky_valid = true;
    held.air = scene.air;
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
    EXPECT_TRUE(plan.sun_lights_air);
}

TEST(Plan, SourceThatMovedAHundredthOfADegreeMakesItsTableStale) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Held held = fresh(scene);
    held.sun_sky_elevation_rad += 0.009 * tests::kDegree;
    EXPECT_FALSE(make_plan(scene, held).needs(Pass::kSunSky));
    held.sun_sky_elevation_rad += 0.002 * tests::kDegree;
    EXPECT_TRUE(make_plan(scene, held).needs(Pass::kSunSky));
}

TEST(Plan, NewWeatherAsksForNewAir) {
    Scene scene = make_scene(30, 180, 10, 0, 1000);
    const Held held = fresh(scene);
    scene.air.visibility_m = 9000;
    EXPECT_TRUE(make_plan(scene, held).needs(Pass::kAirTables));
}

TEST(Plan, StarsGoBecauseTheSkyIsBrightNotBecauseTheSunIsUp) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Held held = fresh(scene);
    held.background_cd_m2 = 2000;
    EXPECT_FALSE(make_plan(scene, held).needs(Pass::kStars));
    held.background_cd_m2 = 2e-4;  // the same Sun, seen from above the air
    const Plan plan = make_plan(scene, held);
    EXPECT_TRUE(plan.needs(Pass::kStars));
    EXPECT_NEAR(plan.star_limit_mag, 7.5, 0.4);
}

TEST(Plan, LimitingMagnitudeFollowsThePublishedTwilightRow) {
    // Zenith luminances and limits of the twilight row: sun -3, -6, -12 deg give 1.6, 3.6, 5.5 mag.
    const Scene scene = make_scene(-6, 180, 10, 0, 0);
    Held held = fresh(scene);
    for (const auto& [background, limit] :
         {std::pair{20.0, 1.6}, std::pair{0.6, 3.6}, std::pair{1.2e-3, 5.5}}) {
        held.background_cd_m2 = background;
        EXPECT_NEAR(make_plan(scene, held).star_limit_mag - 1.0, limit, 0.6) << background;
    }
}

TEST(Plan, MoonlightsTheAirOnlyByNight) {
    EXPECT_FALSE(make_plan(make_scene(10, 0, 40, 180, 0), {}).moon_lights_air);
    EXPECT_TRUE(make_plan(make_scene(-10, 0, 40, 180, 0), {}).moon_lights_air);
    EXPECT_FALSE(make_plan(make_scene(-30, 0, -20, 180, 0), {}).moon_lights_air);
    EXPECT_FALSE(make_plan(make_scene(-30, 0, -20, 180, 0), {}).sun_lights_air);
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
        const Plan plan = make_plan(named.scene, {});
        for (std::size_t i = 0; i < kPassCount; ++i) {
            EXPECT_EQ(static_cast<std::size_t>(plan.passes[i].pass), i);
            EXPECT_FALSE(plan.passes[i].reason.empty()) << pass_name(plan.passes[i].pass);
        }
    }
}

}  // namespace
}  // namespace skyig::render
