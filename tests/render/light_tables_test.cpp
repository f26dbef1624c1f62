#include "render/light_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/sky/staleness.h"
#include "tests/render/light_tables_steps.h"

namespace skyig::render {
namespace {

using tests::kDegree;
using tests::luminance;
using tests::make_scene;
using tests::step;

TEST(LightTables, FirstFrameIsComplete) {
    LightTables tables;
    const SkyLight light = step(tables, make_scene(40, 180, -20, 0, 1000));
    EXPECT_GT(luminance(light, 60, 0), 300.0);
    EXPECT_EQ(tables.revision(), 1U);
}

TEST(LightTables, SlowSunIsFollowedByWholeTablesAFewFramesLater) {
    LightTables tables;
    step(tables, make_scene(40.0, 180, -20, 0, 1000));
    const Scene later = make_scene(40.05, 180, -20, 0, 1000);
    int frames = 0;
    while (tables.revision() == 1 && frames < 50) {
        step(tables, later);
        ++frames;
    }
    EXPECT_GT(frames, 1);
    EXPECT_LT(frames, 20);
    EXPECT_NEAR(tables.held(later).sun_sky_elevation_rad, 40.05 * kDegree, 1e-12);
    // Fresh tables are not built again.
    for (int i = 0; i < 30; ++i)
        step(tables, later);
    EXPECT_EQ(tables.revision(), 2U);
}

TEST(LightTables, JumpOfTheClockShowsTheNewSkyInTheSameFrame) {
    LightTables tables;
    step(tables, make_scene(40, 180, -20, 0, 1000));
    LightTables cold;
    const Scene night = make_scene(-8, 180, -20, 0, 1000);
    EXPECT_DOUBLE_EQ(luminance(step(tables, night), 30, 90), luminance(step(cold, night), 30, 90));
}

TEST(LightTables, NewAirIsTakenOverAfterAFixedNumberOfFrames) {
    Scene scene = make_scene(40, 180, -20, 0, 1000);
    LightTables first;
    LightTables second;
    std::array<std::vector<double>, 2> seen;
    for (int run = 0; run < 2; ++run) {
        LightTables& tables = run == 0 ? first : second;
        Scene s = scene;
        step(tables, s);
        s.air.visibility_m = 8000;
        for (int i = 0; i < 60; ++i)
            seen[static_cast<std::size_t>(run)].push_back(luminance(step(tables, s), 5, 90));
    }
    EXPECT_EQ(seen[0], seen[1]);
    Scene hazy = scene;
    hazy.air.visibility_m = 8000;
    LightTables cold;
    EXPECT_DOUBLE_EQ(seen[0].back(), luminance(step(cold, hazy), 5, 90));
    EXPECT_NE(seen[0].front(), seen[0].back());
}

TEST(LightTables, AModelOfTheSameAirIsTakenOverAtOnce) {
    Scene scene = make_scene(40, 180, -20, 0, 1000);
    LightTables tables;
    step(tables, scene);
    scene.sky.model = SkyModel::kCie;
    scene.sky.cie.type = 5;
    const Held held = tables.held(scene);
    EXPECT_TRUE(held.air_fresh);
    EXPECT_FALSE(held.sun_sky_model);
    const SkyLight light = step(tables, scene);
    EXPECT_NEAR(luminance(light, 10, 0) / luminance(light, 60, 90), 1.0, 0.01);  // type 5 is uniform
    EXPECT_EQ(tables.revision(), 2U);
    step(tables, scene);
    EXPECT_EQ(tables.revision(), 2U);
}

TEST(LightTables, AModelThatNeedsOtherAirWaitsForIt) {
    Scene scene = make_scene(40, 180, -20, 0, 1000);
    LightTables tables;
    const double multi = luminance(step(tables, scene), 20, 90);
    scene.sky.model = SkyModel::kSingle;
    EXPECT_EQ(luminance(step(tables, scene), 20, 90), multi);
    for (int i = 0; i < 60; ++i)
        step(tables, scene);
    LightTables cold;
    const double single = luminance(step(cold, scene), 20, 90);
    EXPECT_DOUBLE_EQ(luminance(step(tables, scene), 20, 90), single);
    EXPECT_LT(single, 0.85 * multi);
}

TEST(LightTables, DayCycleFollowsTheSunAsOftenAsTheOthers) {
    Scene scene = make_scene(20, 180, -20, 0, 1000);
    scene.sky.model = SkyModel::kDayCycle;
    LightTables tables;
    double last = luminance(step(tables, scene), 30, 180);
    double largest = 0.0;
    for (double sun = 20.0; sun > 19.0; sun -= 0.004) {
        scene = make_scene(sun, 180, -20, 0, 1000);
        scene.sky.model = SkyModel::kDayCycle;
        const double now = luminance(step(tables, scene), 30, 180);
        largest = std::max(largest, std::abs(now / last - 1.0));
        last = now;
    }
    std::printf("largest step of a frame: %.5f\n", largest);
    // Passing a place of the Sun's path, the sky lags by the frames that its new table takes.
    EXPECT_LT(largest, 0.008);
    EXPECT_GT(tables.revision(), 100U);
}

TEST(LightTables, WhatMovesSteadilyIsMetHalfWay) {
    // A climb of 10 m/s: the table in use is as often too high as too low, and serves for twice the step.
    LightTables tables;
    int above = 0;
    int below = 0;
    for (int i = 0; i < 400; ++i) {
        const double height_m = 1000.0 + i / 3.0;
        const Scene scene = make_scene(40, 180, -20, 0, height_m);
        step(tables, scene);
        const double off_m = tables.held(scene).sun_sky_height_m - height_m;
        if (i < 50) continue;
        EXPECT_LE(std::abs(off_m), 1.4 * sky::height_step_m(height_m));
        ++(off_m > 0.0 ? above : below);
    }
    EXPECT_GT(above, 100);
    EXPECT_GT(below, 100);
    EXPECT_LT(tables.revision(),
              2U + static_cast<std::uint64_t>(400.0 / 3.0 / (1.4 * sky::height_step_m(1000.0))));
}

TEST(LightTables, FullMoonLightsTheNightAFewHundredThousandthsOfTheDay) {
    LightTables night_tables;
    LightTables day_tables;
    const double night = luminance(step(night_tables, make_scene(-40, 0, 40, 180, 0)), 50, 0);
    const double day = luminance(step(day_tables, make_scene(40, 180, -40, 0, 0)), 50, 0);
    std::printf("full moon sky / sun sky: %.3g, moonlit %.3g cd/m2\n", night / day, night);
    // Sun to full Moon: 14 magnitudes (4e5), the surge is not at its peak here; the natural night adds to the
    // Moon's.
    EXPECT_GT(night / day, 0.8e-6);
    EXPECT_LT(night / day, 4.0e-6);
}

TEST(LightTables, EyeBelowTheEllipsoidKeepsItsTables) {
    for (const double height_m : {-3.0, -30.0, -400.0}) {
        LightTables tables;
        for (int i = 0; i < 60; ++i)
            step(tables, make_scene(40, 180, -20, 0, height_m));
        EXPECT_EQ(tables.revision(), 1U) << height_m;
    }
}

TEST(LightTables, TemperatureMakesNoNewAir) {
    LightTables tables;
    Scene scene = make_scene(40, 180, -20, 0, 1000);
    for (int i = 0; i < 100; ++i) {
        step(tables, scene);
        scene.air.temperature_c += 0.1;
        scene.air.humidity_pct += 0.1;
    }
    EXPECT_EQ(tables.revision(), 1U);
}

TEST(LightTables, HorizonFollowsTheEyeExactlyInAClimb) {
    LightTables tables;
    for (int i = 0; i < 200; ++i) {
        const double height_m = 3.0 + 0.33 * i;
        const SkyLight light = step(tables, make_scene(20, 180, -20, 0, height_m));
        EXPECT_NEAR(light.straight_horizon_rad, -std::acos(6371e3 / (6371e3 + height_m)), 1e-9);
        EXPECT_NEAR(light.horizon_elevation_rad / light.straight_horizon_rad, 0.911, 0.002);
    }
}

TEST(LightTables, DarkSkyIsBrighterThanTheGroundDownToTheHorizon) {
    LightTables tables;
    const SkyLight light = step(tables, make_scene(-50, 0, -50, 0, 10));
    for (double elevation = 0.05; elevation < 90.0; elevation += 0.5)
        EXPECT_GT(luminance(light, elevation, 0), luminance(light, -10.0, 0)) << elevation;
}

TEST(LightTables, EclipsedSunDimsItsSky) {
    Scene scene = make_scene(40, 180, -20, 0, 1000);
    LightTables tables;
    const double full = luminance(step(tables, scene), 30, 90);
    scene.sun.unobscured = 0.25;
    EXPECT_NEAR(luminance(step(tables, scene), 30, 90) / full, 0.25, 1e-3);
}

}  // namespace
}  // namespace skyig::render
