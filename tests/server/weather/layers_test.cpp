#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "render/weather_area.h"
#include "server/start_weather/start_weather.h"
#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

using cigi::CloudType;
using cigi::EnvRegionControl;
using cigi::WeatherControl;
using render::CloudGenus;

constexpr double kLat = 47.4582, kLon = 8.5555;

/// Coverage of the shown cloud of that genus, 0 if there is none.
double coverage_of(const WeatherBench& bench, CloudGenus genus) {
    for (const render::CloudLayer& cloud : bench.weather().all_clouds())
        if (cloud.genus == genus) return cloud.coverage;
    return 0.0;
}

const WeatherControl kGlobal = cloud(1, CloudType::kStratus, 1000.0F, 80.0F);
const WeatherControl kRegional = cloud(1, CloudType::kCumulus, 1000.0F, 40.0F);

TEST(Layers, AStormFortyKilometresAheadIsThere) {
    WeatherBench bench;
    WeatherControl storm = in_region(cloud(1, CloudType::kCumulonimbus, 600.0F, 75.0F), 7);
    storm.random_lightning = true;
    WeatherControl rain = in_region(cloud(4, CloudType::kNone, 0.0F, 100.0F), 7);
    rain.severity = 3;
    // 40 km north, by the meridian's radius of curvature there.
    bench.send(region(7, kLat + 0.35980, kLon, 10e3F, 2e3F), storm, rain);
    bench.settle();
    ASSERT_EQ(bench.weather().cloud_count, 1U);
    const render::CloudLayer& shown = bench.weather().clouds[0];
    ASSERT_TRUE(shown.area);
    EXPECT_NEAR(shown.area->centre_m.y, 40e3, 30.0);
    EXPECT_NEAR(shown.area->centre_m.x, 0.0, 1e-3);
    EXPECT_DOUBLE_EQ(shown.area->half_size_m.x, 5000.0);
    ASSERT_EQ(bench.weather().lightning_count, 1U);
    EXPECT_EQ(bench.weather().lightnings[0].layer, 0U);
    EXPECT_EQ(bench.weather().obscurant_count, 1U) << "its rain dims the view";
    EXPECT_EQ(bench.weather().precipitation_count, 0U) << "and does not fall here";
}

config::Config with_area(const config::WeatherArea& area) {
    config::Config config = world::three_channels();
    config.weather.areas.push_back(area);
    return config;
}

TEST(Layers, AnAreaOfTheSettingsIsTheRegionThatAHostWouldMake) {
    config::WeatherArea area;
    area.latitude_deg = kLat + 0.35980;
    area.longitude_deg = kLon;
    area.rotation_deg = 90.0;
    area.half_length_m = 9e3;
    area.half_width_m = 5e3;
    area.corner_radius_m = 1e3;
    area.perimeter_m = 2e3;
    config::WeatherLayer storm;
    storm.type = config::LayerType::kCumulonimbus;
    storm.base_m = 600.0;
    storm.thickness_m = 500.0;
    storm.coverage = 0.75;
    area.layers = {storm};
    WeatherBench bench(with_area(area));
    bench.frame();
    ASSERT_EQ(bench.weather().cloud_count, 1U);
    ASSERT_TRUE(bench.weather().clouds[0].area);
    // Its length lies east and west: 40 km north of the eye, 5 km to the edge.
    EXPECT_NEAR(render::area_distance_m(*bench.weather().clouds[0].area, {0.0, 0.0}), 35e3, 30.0);
    EXPECT_NEAR(render::area_distance_m(*bench.weather().clouds[0].area, {20e3, 40e3}), 11e3, 30.0);

    WeatherBench told;
    cigi::EnvRegionControl by_host = region(1, area.latitude_deg, kLon, 18e3F, 2e3F);
    by_host.size_y = 10e3F;
    by_host.corner_radius = 1e3F;
    by_host.rotation = 90.0F;
    told.send(by_host, in_region(cloud(1, CloudType::kCumulonimbus, 600.0F, 75.0F), 1));
    told.settle();
    EXPECT_EQ(*told.weather().clouds[0].area, *bench.weather().clouds[0].area);
    EXPECT_EQ(told.weather().clouds[0].coverage, bench.weather().clouds[0].coverage);
    EXPECT_EQ(told.weather().clouds[0].base_m, bench.weather().clouds[0].base_m);
}

TEST(Layers, AreasOfTheSettingsTakeFreeIdsAndComeBackInStandby) {
    config::WeatherArea area;
    area.latitude_deg = kLat;
    area.longitude_deg = kLon;
    area.half_length_m = area.half_width_m = 10e3;
    config::WeatherLayer layer;
    layer.base_m = 1000.0;
    layer.thickness_m = 500.0;
    area.layers = {layer};
    config::Config config = with_area(area);
    area.id = 1;
    area.layers[0].type = config::LayerType::kStratus;
    config.weather.areas.push_back(area);
    const StartWeather start = start_weather(config);
    ASSERT_EQ(start.regions.size(), 2U);
    EXPECT_EQ(start.regions[0].region_id, 2U);
    EXPECT_EQ(start.regions[1].region_id, 1U);
    WeatherBench bench(config);
    bench.frame();
    EXPECT_EQ(bench.weather().cloud_count, 1U) << "the later area covers the earlier one";
    EXPECT_EQ(coverage_of(bench, CloudGenus::kStratus), 1.0);
    cigi::EnvRegionControl gone = region(1, kLat, kLon, 20e3F);
    gone.region_state = cigi::RegionState::kDestroyed;
    bench.send(gone);
    bench.settle();
    EXPECT_EQ(coverage_of(bench, CloudGenus::kStratus), 0.0);
    EXPECT_EQ(coverage_of(bench, CloudGenus::kCumulus), 1.0);
    bench.host.mode = cigi::IgMode::kStandby;
    bench.send();
    bench.frame();
    EXPECT_EQ(coverage_of(bench, CloudGenus::kStratus), 1.0);
}

TEST(Layers, GlobalLayersGiveWayToARegionsAtTheEye) {
    WeatherBench bench;
    bench.send(kGlobal, region(1, kLat, kLon, 10e3F), in_region(kRegional, 1));
    bench.settle();
    EXPECT_EQ(coverage_of(bench, CloudGenus::kStratus), 0.0);
    EXPECT_NEAR(coverage_of(bench, CloudGenus::kCumulus), 0.4, 1e-6);
    // In the middle of the perimeter by half: 5 km beyond the edge of 10 km.
    bench.send(region(1, kLat + 0.1349, kLon, 20e3F, 10e3F));
    bench.settle();
    EXPECT_NEAR(coverage_of(bench, CloudGenus::kStratus), 0.4, 0.01);
    // Outside of it as they are; switched off too.
    bench.send(region(1, kLat + 1.0, kLon, 10e3F));
    bench.settle();
    EXPECT_NEAR(coverage_of(bench, CloudGenus::kStratus), 0.8, 1e-6);
}

TEST(Layers, OnlyLayersOfTheSameKindAndHeightHide) {
    WeatherBench bench;
    WeatherControl fog = in_region(cloud(0, CloudType::kNone, 1000.0F, 100.0F), 1);
    bench.send(kGlobal, region(1, kLat, kLon, 10e3F), fog,
               in_region(cloud(2, CloudType::kCirrus, 9000.0F, 50.0F), 1));
    bench.settle();
    EXPECT_NEAR(coverage_of(bench, CloudGenus::kStratus), 0.8, 1e-6);
    // One that takes the upper half of its height.
    bench.send(in_region(cloud(3, CloudType::kStratocumulus, 1250.0F, 50.0F), 1));
    bench.settle();
    EXPECT_NEAR(coverage_of(bench, CloudGenus::kStratus), 0.4, 1e-6);
}

TEST(Layers, OfTwoRegionsTheLaterCoversUnlessItMerges) {
    for (const bool merges : {false, true}) {
        WeatherBench bench;
        EnvRegionControl first = region(2, kLat, kLon, 10e3F), second = region(1, kLat, kLon, 10e3F);
        second.merge_weather = merges;
        bench.send(kGlobal, first, in_region(kRegional, 2));
        bench.send(second, in_region(cloud(1, CloudType::kStratocumulus, 900.0F, 60.0F), 1));
        bench.settle();
        EXPECT_EQ(coverage_of(bench, CloudGenus::kStratus), 0.0);
        EXPECT_NEAR(coverage_of(bench, CloudGenus::kStratocumulus), 0.6, 1e-6);
        // 900..1400 m takes 400 of the 500 m of the first's.
        EXPECT_NEAR(coverage_of(bench, CloudGenus::kCumulus), merges ? 0.4 : 0.4 * 0.2, 1e-6);
        // Whoever is sent again is the last.
        bench.send(first);
        bench.settle();
        EXPECT_NEAR(coverage_of(bench, CloudGenus::kCumulus), 0.4, 1e-6);
        EXPECT_NEAR(coverage_of(bench, CloudGenus::kStratocumulus), 0.6 * 0.2, 1e-6);
    }
}

TEST(Layers, WeatherOfAnEntityMovesWithIt) {
    WeatherBench bench;
    cigi::EntityControl carrier;
    carrier.entity_id = 9;
    carrier.entity_state = cigi::EntityState::kActive;
    carrier.lat_x = kLat + 0.05;
    carrier.lon_y = kLon;
    carrier.alt_z = 3000.0;
    WeatherControl smoke = cloud(0, CloudType::kNone, 0.0F, 100.0F);
    smoke.scope = cigi::WeatherScope::kEntity;
    smoke.entity_region_id = 9;
    smoke.transition_band = 800.0F;
    smoke.visibility = 100.0F;
    smoke.thickness = 0.0F;
    bench.send(carrier, smoke);
    bench.settle();
    ASSERT_EQ(bench.weather().obscurant_count, 1U);
    const render::Obscurant& shown = bench.weather().obscurants[0];
    ASSERT_TRUE(shown.area);
    EXPECT_NEAR(shown.area->centre_m.y, 5560.0, 10.0);
    EXPECT_DOUBLE_EQ(shown.area->perimeter_m, 800.0);
    EXPECT_DOUBLE_EQ(shown.base_m - shown.bottom_band_m, 2200.0);
    EXPECT_DOUBLE_EQ(shown.top_m + shown.top_band_m, 3800.0);
    carrier.lat_x = kLat - 0.05;
    bench.send(carrier);
    bench.frame();
    EXPECT_NEAR(bench.weather().obscurants[0].area->centre_m.y, -5560.0, 10.0);
}

TEST(Layers, TheNearestAreKeptAndTheOthersCounted) {
    WeatherBench bench;
    for (std::uint16_t i = 1; i <= 20; ++i) {
        bench.send(region(i, kLat + 0.1 * i, kLon, 1e3F), in_region(kRegional, i));
    }
    bench.settle();
    EXPECT_EQ(bench.weather().cloud_count, render::Weather::kMaxClouds);
    EXPECT_EQ(bench.scenes.weather_left_out(), 4U);
    double before_m = 0.0;
    for (const render::CloudLayer& shown : bench.weather().all_clouds()) {
        EXPECT_GT(shown.area->centre_m.y, before_m);
        before_m = shown.area->centre_m.y;
    }
    EXPECT_NEAR(before_m, 1.6 * 111e3, 1e3);
    // More than are gathered.
    for (std::uint16_t i = 21; i <= 120; ++i) {
        bench.send(region(i, kLat + 0.02 * i, kLon, 1e3F), in_region(kRegional, i));
    }
    bench.settle();
    EXPECT_EQ(bench.weather().cloud_count, render::Weather::kMaxClouds);
    EXPECT_EQ(bench.scenes.weather_left_out(), 120U - 16U);
}

TEST(Layers, InactiveAndDestroyedRegionsTakeTheirLayersAway) {
    WeatherBench bench;
    EnvRegionControl here = region(1, kLat, kLon, 10e3F);
    bench.send(here, in_region(kRegional, 1));
    bench.settle();
    EXPECT_EQ(bench.weather().cloud_count, 1U);
    here.region_state = cigi::RegionState::kInactive;
    bench.send(here);
    bench.settle();
    EXPECT_EQ(bench.weather().cloud_count, 0U);
    here.region_state = cigi::RegionState::kActive;
    bench.send(here);
    bench.settle();
    EXPECT_EQ(bench.weather().cloud_count, 1U);
    here.region_state = cigi::RegionState::kDestroyed;
    bench.send(here);
    bench.settle();
    EXPECT_EQ(bench.weather().cloud_count, 0U);
}

TEST(Layers, RainFallsWhereTheEyeIsBelowItsTop) {
    config::Config config = world::three_channels();
    config.start.height_m = 500.0;
    WeatherBench bench(config);
    WeatherControl rain = cloud(4, CloudType::kNone, 0.0F, 100.0F);
    rain.thickness = 1200.0F;
    rain.severity = 2;
    bench.send(rain);
    bench.settle();
    ASSERT_EQ(bench.weather().precipitation_count, 1U);
    EXPECT_DOUBLE_EQ(bench.weather().precipitations[0].rate_mm_h, 5.0);
    EXPECT_DOUBLE_EQ(bench.weather().precipitations[0].top_m, 1200.0);
    cigi::EntityControl up;
    up.entity_state = cigi::EntityState::kActive;
    up.lat_x = kLat;
    up.lon_y = kLon;
    up.alt_z = 1500.0;
    bench.send(up);
    bench.frame();
    EXPECT_EQ(bench.weather().precipitation_count, 0U) << "above its top";
}

}  // namespace
}  // namespace skyig::server::weather
