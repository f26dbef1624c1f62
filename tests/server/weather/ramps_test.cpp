#include "server/weather/ramps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "render/weather_ramp.h"
#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

using cigi::CloudType;
using cigi::WeatherControl;
using render::CloudGenus;

constexpr double kFrame_s = 1.0 / 60.0;
/// A frame's part of the ten seconds.
constexpr double kPart = kFrame_s / 10.0;

TEST(Ramps, ACloudGrowsEvenlyAndEndsWhereItWasTold) {
    WeatherBench bench;
    bench.frame();
    bench.send(cloud(1, CloudType::kCumulus, 1000.0F, 80.0F));
    double before = 0.0, largest = 0.0;
    int frames = 0;
    while (before < 0.8 && frames < 1000) {
        bench.frame(kFrame_s);
        const double now = bench.weather().cloud_count == 0 ? 0.0 : bench.weather().clouds[0].coverage;
        EXPECT_GE(now, before);
        largest = std::max(largest, now - before);
        before = now;
        ++frames;
    }
    std::printf("  0 to 80 %% in %d frames, largest step %.3f %%\n", frames, 100.0 * largest);
    EXPECT_NEAR(frames * kFrame_s, 10.0, 2.0 * kFrame_s);
    // The first clouds take longer than their part.
    EXPECT_LE(largest, render::CoverScale::place_of(0.8) * kPart * 1.001);
    EXPECT_EQ(before, static_cast<double>(80.0F) / 100.0);
    EXPECT_EQ(bench.weather().clouds[0].base_m, 1000.0);
}

TEST(Ramps, EveryMemberGoesItsWayAndTurnsBackWithoutAStep) {
    WeatherBench bench;
    WeatherControl layer = cloud(1, CloudType::kStratus, 300.0F, 100.0F);
    layer.visibility = 500.0F;
    bench.send(layer);
    bench.settle();
    WeatherControl changed = layer;
    changed.base_elevation = 900.0F;
    changed.thickness = 1500.0F;
    changed.visibility = 50.0F;
    changed.transition_band = changed.top_transition_band = 60.0F;
    bench.send(changed);
    render::CloudLayer before = bench.weather().clouds[0];
    double base_step_m = 0.0, extinction_step_ln = 0.0;
    for (int i = 0; i < 300; ++i) {
        if (i == 150) bench.send(layer);
        const render::CloudLayer& now = bench.frame(kFrame_s).weather.clouds[0];
        base_step_m = std::max(base_step_m, std::abs(now.base_m - before.base_m));
        extinction_step_ln =
            std::max(extinction_step_ln, std::abs(std::log(now.extinction_per_m / before.extinction_per_m)));
        before = now;
    }
    EXPECT_LE(base_step_m, 600.0 * kPart * 1.001);
    EXPECT_LE(extinction_step_ln, std::log(500.0 / 50.0) * kPart * 1.02);
    EXPECT_GT(before.base_m, 300.0);
    bench.settle();
    EXPECT_EQ(bench.weather().clouds[0].base_m, 300.0);
}

TEST(Ramps, ACloudThatIsToldAVisibilityGoesThereEvenlyFromWhatItsGenusHas) {
    for (const CloudType type : {CloudType::kCumulus, CloudType::kStratus, CloudType::kCirrostratus}) {
        WeatherBench bench;
        WeatherControl layer = cloud(1, type, 1000.0F, 100.0F);
        bench.send(layer);
        bench.settle();
        const double own = bench.weather().clouds[0].extinction_per_m;
        layer.visibility = 20.0F;
        const double told = -std::log(0.05) / 20.0;
        double before = own, largest_ln = 0.0;
        for (const float visibility_m : {20.0F, 0.0F}) {
            layer.visibility = visibility_m;
            bench.send(layer);
            for (int i = 0; i < 620; ++i) {
                const double now = bench.frame(kFrame_s).weather.clouds[0].extinction_per_m;
                largest_ln = std::max(largest_ln, std::abs(std::log(now / before)));
                before = now;
            }
            EXPECT_NEAR(before, visibility_m > 0.0F ? told : own, 1e-9);
        }
        EXPECT_GT(own, 0.0);
        EXPECT_LE(largest_ln, std::log(told / own) * kPart * 1.05);
    }
}

/// A host may stream its own slow change: what is shown follows, and does not stand still.
TEST(Ramps, WhatChangesInEveryFrameIsFollowed) {
    WeatherBench bench;
    cigi::AtmosphereControl air;
    air.model_enable = true;
    WeatherControl layer = cloud(1, CloudType::kStratus, 300.0F, 100.0F);
    for (int i = 0; i < 3600; ++i) {
        layer.base_elevation = 300.0F + static_cast<float>(i) / 60.0F;  // 1 m/s
        air.visibility = 50'000.0F / (1.0F + static_cast<float>(i) / 3600.0F);
        bench.send(layer, air);
        bench.frame(kFrame_s);
    }
    const double behind_m = static_cast<double>(layer.base_elevation) - bench.weather().clouds[0].base_m;
    std::printf("  a base that rises by 1 m/s is %.2f m behind\n", behind_m);
    EXPECT_GT(behind_m, 0.0);
    EXPECT_LT(behind_m, 10.1);
    EXPECT_NEAR(bench.scene.air.visibility_m, 25'000.0 / (1.0 - 10.0 / 120.0), 100.0);
    EXPECT_NEAR(bench.weather().clouds[0].coverage, 1.0, 0.01);
}

TEST(Ramps, AnotherGenusFadesInWhileTheOldFadesOut) {
    WeatherBench bench;
    bench.send(cloud(1, CloudType::kCumulus, 1000.0F, 50.0F));
    bench.settle();
    bench.send(cloud(1, CloudType::kStratus, 1000.0F, 100.0F));
    for (int i = 0; i < 5; ++i)
        bench.frame(1.0);
    ASSERT_EQ(bench.weather().cloud_count, 2U);
    // Half of the way, in which the first clouds and the last gaps have more time.
    using Scale = render::CoverScale;
    for (const render::CloudLayer& cloud : bench.weather().all_clouds()) {
        const double all = cloud.genus == CloudGenus::kStratus ? 1.0 : 0.5;
        EXPECT_NEAR(cloud.coverage, Scale::value_at(0.5 * Scale::place_of(all)), 1e-6);
    }
    bench.settle();
    ASSERT_EQ(bench.weather().cloud_count, 1U);
    EXPECT_EQ(bench.weather().clouds[0].genus, CloudGenus::kStratus);
}

TEST(Ramps, AVisibilityOfTheAirChangesEvenlyAsWhatIsSeenThroughIt) {
    WeatherBench bench;
    cigi::AtmosphereControl air;
    air.model_enable = true;
    air.pressure = 1013.25F;
    air.air_temperature = 15.0F;
    air.visibility = 50'000.0F;
    bench.send(air);
    bench.settle();
    EXPECT_EQ(bench.scene.air.visibility_m, 50'000.0);
    air.visibility = 2000.0F;
    bench.send(air);
    for (int i = 0; i < 5; ++i)
        bench.frame(1.0);
    // Half way of the logarithms, but for the clear air that is never told.
    const double clear = 2e-5, depth = -std::log(0.05);
    const double half = std::sqrt((clear + depth / 50e3) * (clear + depth / 2e3)) - clear;
    EXPECT_NEAR(depth / bench.scene.air.visibility_m, half, 1e-12);
    bench.settle();
    EXPECT_EQ(bench.scene.air.visibility_m, 2000.0);
    EXPECT_EQ(bench.weather().obscurant_count, 0U);
}

/// Black things far and near, as a fog of 300 m comes over air of 50 km and goes, in a minute.
TEST(Ramps, FogComesAndGoesWithoutStepsAtAnyDistance) {
    config::Config config = world::three_channels();
    config.weather.transition_s = 60.0;
    config.air.visibility_m = 50e3;
    WeatherBench bench(config);
    bench.frame();
    WeatherControl fog = cloud(0, CloudType::kNone, -1000.0F, 100.0F);
    fog.thickness = 3000.0F;
    fog.visibility = 300.0F;
    double largest = 0.0;
    const auto passed = [&](double distance_m) {
        double extinction = -std::log(0.05) / bench.scene.air.visibility_m;
        for (const render::Obscurant& shown : bench.weather().all_obscurants())
            extinction += shown.extinction_per_m;
        return std::exp(-extinction * distance_m);
    };
    for (const bool comes : {true, false}) {
        fog.weather_enable = comes;
        bench.send(fog);
        for (int i = 0; i < 3700; ++i) {
            const std::array before{passed(100.0), passed(1e3), passed(1e4), passed(5e4)};
            bench.frame(kFrame_s);
            const std::array after{passed(100.0), passed(1e3), passed(1e4), passed(5e4)};
            for (std::size_t k = 0; k < before.size(); ++k)
                largest = std::max(largest, std::abs(after[k] - before[k]));
        }
        EXPECT_EQ(bench.weather().obscurant_count, comes ? 1U : 0U);
    }
    std::printf("  largest step of what passes %.3f/255\n", 255.0 * largest);
    EXPECT_LT(255.0 * largest, 0.3);
}

TEST(Ramps, AirThickerThanTheTablesGoesOverIntoFogWithoutAStep) {
    WeatherBench bench;
    cigi::AtmosphereControl air;
    air.model_enable = true;
    air.visibility = 1100.0F;
    bench.send(air);
    bench.settle();
    air.visibility = 200.0F;
    bench.send(air);
    const double depth = -std::log(0.05);
    double before = depth / 1100.0, largest_ln = 0.0;
    for (int i = 0; i < 620; ++i) {
        bench.frame(kFrame_s);
        double now = depth / bench.scene.air.visibility_m;
        for (const render::Obscurant& fog : bench.weather().all_obscurants())
            now += fog.extinction_per_m;
        EXPECT_GE(now, before - 1e-15);
        largest_ln = std::max(largest_ln, std::log(now / before));
        before = now;
    }
    EXPECT_NEAR(before, depth / 200.0, 1e-12);
    EXPECT_LE(largest_ln, std::log(1100.0 / 200.0) * kPart * 1.01);
    EXPECT_EQ(bench.scene.air.visibility_m, 1000.0);
}

TEST(Ramps, AJumpOfTheClockAndStandbyShowWhatIsTold) {
    WeatherBench bench;
    bench.settle();
    cigi::CelestialSphereControl later;
    later.hour = 18;
    later.date = 6212026;
    later.date_time_valid = later.sun_enable = true;
    bench.send(cloud(1, CloudType::kCumulus, 1000.0F, 80.0F), later);
    bench.frame();
    EXPECT_NEAR(bench.weather().clouds[0].coverage, 0.8, 1e-6);
    bench.host.mode = cigi::IgMode::kStandby;
    bench.send();
    bench.frame();
    EXPECT_EQ(bench.weather().cloud_count, 0U);
}

TEST(Ramps, AreOffAtATransitionOfZero) {
    config::Config config = world::three_channels();
    config.weather.transition_s = 0.0;
    WeatherBench bench(config);
    bench.frame();
    bench.send(cloud(1, CloudType::kCumulus, 1000.0F, 80.0F));
    bench.frame();
    EXPECT_NEAR(bench.weather().clouds[0].coverage, 0.8, 1e-6);
}

TEST(Ramps, ARegionThatOpensHidesGraduallyToo) {
    WeatherBench bench;
    bench.send(cloud(1, CloudType::kStratus, 1000.0F, 100.0F));
    bench.settle();
    bench.send(region(1, 47.4582, 8.5555, 10e3F),
               in_region(cloud(1, CloudType::kCumulus, 1000.0F, 50.0F), 1));
    double before = 1.0;
    for (int i = 0; i < 650; ++i) {
        bench.frame(kFrame_s);
        double now = 0.0;
        for (const render::CloudLayer& cloud : bench.weather().all_clouds())
            if (cloud.genus == CloudGenus::kStratus) now = cloud.coverage;
        EXPECT_LE(before - now, kPart * 1.001);
        EXPECT_LE(now, before);
        before = now;
    }
    EXPECT_EQ(before, 0.0);
}

TEST(Ramps, ARegionThatIsToldLargerGrowsMovesAndTurnsEvenly) {
    WeatherBench bench;
    auto told = region(1, 47.4582, 8.5555, 4e3F, 500.0F);
    bench.send(told, in_region(cloud(1, CloudType::kCumulus, 1000.0F, 50.0F), 1));
    bench.settle();
    told.size_x = told.size_y = 40e3F;
    told.corner_radius = 1e3F;
    told.transition_perimeter = 4e3F;
    told.latitude += 0.18;  // 20 km
    told.rotation = -90.0F;
    bench.send(told);
    render::WeatherArea before = *bench.weather().clouds[0].area;
    EXPECT_EQ(before.half_size_m.x, 2e3);
    double grown_m = 0.0, moved_m = 0.0, turned_rad = 0.0, faded_m = 0.0;
    for (int i = 0; i < 620; ++i) {
        const render::WeatherArea now = *bench.frame(kFrame_s).weather.clouds[0].area;
        grown_m = std::max(grown_m, std::abs(now.half_size_m.x - before.half_size_m.x));
        moved_m = std::max(moved_m, glm::distance(now.centre_m, before.centre_m));
        turned_rad = std::max(turned_rad, std::abs(now.axis_rad - before.axis_rad));
        faded_m = std::max(faded_m, std::abs(now.perimeter_m - before.perimeter_m));
        before = now;
    }
    std::printf("  a frame: %.1f m larger, %.1f m on, %.2f mrad round\n", grown_m, moved_m, 1e3 * turned_rad);
    EXPECT_LE(grown_m, 17e3 * kPart * 1.001);
    EXPECT_LE(moved_m, 20.1e3 * kPart * 1.001);
    EXPECT_LE(turned_rad, M_PI / 2.0 * kPart * 1.01);
    EXPECT_LE(faded_m, 3.5e3 * kPart * 1.001);
    EXPECT_EQ(before.half_size_m.x, 19e3);
    EXPECT_EQ(before.corner_radius_m, 1e3);
    EXPECT_NEAR(before.centre_m.y, 20e3, 50.0);
}

}  // namespace
}  // namespace skyig::server::weather
