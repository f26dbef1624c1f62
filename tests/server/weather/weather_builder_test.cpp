#include "server/weather/weather_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "config/warp/grey_map.h"
#include "render/cloud/field/texture.h"
#include "server/start_weather/layers.h"
#include "server/world/conditions.h"
#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

using cigi::CloudType;
using cigi::WeatherControl;

constexpr double kLat = 47.4582, kLon = 8.5555;

cigi::AtmosphereControl wind(float speed_m_s, float from_deg) {
    cigi::AtmosphereControl air;
    air.model_enable = true;
    air.visibility = 50'000.0F;
    air.wind_horizontal = speed_m_s;
    air.wind_direction = from_deg;
    return air;
}

TEST(WeatherBuilder, ADayOfWindHasNoJump) {
    WeatherBench bench;
    bench.send(wind(10.0F, 270.0F), cloud(1, CloudType::kCumulus, 1000.0F, 50.0F));
    const double speed_m_s = 10.0 * wind_gain(1000.0);
    EXPECT_NEAR(wind_gain(1000.0), std::pow(30.0, 0.14), 1e-12) << "as at 300 m";
    double before_m = 0.0, worst_m = 0.0;
    bench.frame(1.0);
    for (int second = 2; second <= 86400; ++second) {
        const double now_m = bench.frame(1.0).weather.clouds[0].drift_m.x;
        if (second > 2) worst_m = std::max(worst_m, std::abs(now_m - before_m - speed_m_s));
        before_m = now_m;
    }
    std::printf("  24 h at 1 Hz: %.3f km east, largest deviation of a step %.1e m\n", before_m / 1e3,
                worst_m);
    EXPECT_NEAR(before_m, speed_m_s * 86400.0, 1e-5);
    EXPECT_LT(worst_m, 1e-6);
    const render::CloudLayer shown = bench.weather().clouds[0];
    EXPECT_NEAR(shown.drift_m.y, 0.0, 1e-6);
    bench.send(wind(30.0F, 0.0F));
    bench.frame(1.0 / 60.0);
    EXPECT_LT(glm::distance(bench.weather().clouds[0].drift_m, shown.drift_m), 1.0);
}

TEST(WeatherBuilder, CloudsOfATypeLookAsTheirSheetSays) {
    config::Config config = world::three_channels();
    config::WeatherSheet sheet;
    sheet.type = config::LayerType::kCirrus;
    sheet.colour = {1.0, 0.9, 0.8};
    sheet.textures.resize(2);
    config::warp::GreyMap grey{16, 16, std::vector<float>(256, 0.25F)};
    sheet.textures[0].image = std::make_shared<config::warp::GreyMap>(std::move(grey));
    sheet.textures[0].size_m = 30'000.0;
    sheet.textures[1].noise = config::CloudNoise::kFibres;
    sheet.textures[1].scroll_m_s = 10.0;
    sheet.textures[1].scroll_from_deg = 270.0;
    config.weather.sheets.push_back(sheet);
    WeatherBench bench(config);
    bench.send(cloud(1, CloudType::kCirrus, 9000.0F, 50.0F), cloud(2, CloudType::kCumulus, 1000.0F, 50.0F));
    const render::Weather& weather = bench.frame(1.0).weather;
    ASSERT_EQ(weather.cloud_count, 2U);
    for (const render::CloudLayer& layer : weather.all_clouds()) {
        const bool cirrus = layer.genus == render::CloudGenus::kCirrus;
        ASSERT_EQ(layer.look.has_value(), cirrus);
        if (!cirrus) continue;
        const auto& tiles = layer.look->tiles;
        ASSERT_TRUE(tiles[0].picture);
        EXPECT_EQ(tiles[0].picture->side(), 16);
        EXPECT_EQ(tiles[0].times, 4);
        EXPECT_EQ(tiles[1].noise, render::CloudNoise::kFibres);
        EXPECT_NEAR(tiles[1].scroll_m_s.x, 10.0, 1e-9);
        EXPECT_EQ(tiles[2].weight, 0.0);
        EXPECT_EQ(layer.look->colour.z, 0.8);
    }
}

TEST(WeatherBuilder, TheEyeHasItsOwnVelocityAndWind) {
    WeatherBench bench;
    cigi::EntityControl ownship;
    ownship.entity_state = cigi::EntityState::kActive;
    ownship.lat_x = kLat;
    ownship.lon_y = kLon;
    ownship.alt_z = 5000.0;
    for (int i = 0; i < 120; ++i) {
        ownship.lat_x += 100.0 / 60.0 / 111'178.0;  // 100 m/s to the north
        ownship.alt_z += 5.0 / 60.0;
        bench.send(ownship, wind(10.0F, 90.0F));
        bench.frame();
    }
    std::printf("  eye velocity %.2f east, %.2f north, %.2f up m/s\n", bench.weather().eye_velocity_m_s.x,
                bench.weather().eye_velocity_m_s.y, bench.weather().eye_velocity_m_s.z);
    EXPECT_NEAR(bench.weather().eye_velocity_m_s.y, 100.0, 0.5);
    EXPECT_NEAR(bench.weather().eye_velocity_m_s.z, 5.0, 0.05);
    EXPECT_NEAR(bench.weather().wind_m_s.x, -10.0 * wind_gain(5000.0), 1e-9);
    // In a layer that tells a wind, that one.
    WeatherControl layer = cloud(1, CloudType::kStratus, 4900.0F, 100.0F);
    layer.wind_horizontal = 40.0F;
    layer.wind_direction = 180.0F;
    bench.send(layer);
    bench.frame();
    bench.frame();
    EXPECT_NEAR(bench.weather().wind_m_s.y, 40.0, 1e-6);
    EXPECT_NEAR(bench.weather().clouds[0].drift_m.y, 40.0 * bench.scene.time_s, 1e-6);
    // Put elsewhere it does not race.
    ownship.lat_x += 2.0;
    bench.send(ownship);
    bench.frame();
    EXPECT_EQ(bench.weather().eye_velocity_m_s, glm::dvec3(0.0));
}

TEST(WeatherBuilder, AWindThatIsToldLaterMovesTheSettingsLayersToo) {
    config::Config config = world::three_channels();
    config.air.wind_m_s = 5.0;
    config.air.wind_from_deg = 270.0;
    config.start.height_m = 1000.0;
    config::WeatherLayer cumulus, rain;
    cumulus.type = config::LayerType::kCumulus;
    cumulus.base_m = 1500.0;
    cumulus.thickness_m = 500.0;
    rain.type = config::LayerType::kRain;
    rain.base_m = -1000.0;
    rain.thickness_m = 2500.0;
    rain.rate_mm_h = 5.0;
    config.weather.layers = {cumulus, rain};
    WeatherBench bench(config);
    bench.settle();
    EXPECT_NEAR(bench.weather().wind_m_s.x, 5.0 * wind_gain(1000.0), 1e-9) << "the eye's height counts";
    bench.send(wind(40.0F, 180.0F));
    bench.frame(1.0);
    const glm::dvec2 before_m = bench.weather().clouds[0].drift_m;
    const glm::dvec2 step_m = bench.frame(1.0).weather.clouds[0].drift_m - before_m;
    EXPECT_NEAR(step_m.x, 0.0, 1e-6);
    EXPECT_NEAR(step_m.y, 40.0 * wind_gain(1500.0), 1e-6);
    EXPECT_NEAR(bench.weather().wind_m_s.y, 40.0 * wind_gain(1000.0), 1e-6);
}

/// What a busy host may have told: global layers, storms around, changes all the time.
void tell(WeatherBench& bench, int frame) {
    WeatherControl layer =
        cloud(static_cast<std::uint8_t>(1 + frame % 3), CloudType::kCumulus,
              1000.0F + static_cast<float>(frame % 50), static_cast<float>(10 + frame % 90));
    WeatherControl rain =
        in_region(cloud(4, CloudType::kNone, 0.0F, 100.0F), static_cast<std::uint16_t>(frame % 8));
    rain.severity = static_cast<std::uint8_t>(frame % 6);
    bench.send(wind(static_cast<float>(frame % 20), static_cast<float>(frame % 360)), layer, rain,
               region(static_cast<std::uint16_t>(frame % 8), kLat + 0.01 * (frame % 8), kLon, 5e3F, 3e3F));
}

TEST(WeatherBuilder, TwoBuildersOfTheSamePacketsAgreeToTheBit) {
    WeatherBench a, b;
    for (int frame = 0; frame < 600; ++frame) {
        tell(a, frame);
        tell(b, frame);
        const render::Weather& one = a.frame().weather;
        const render::Weather& two = b.frame().weather;
        ASSERT_EQ(one.cloud_count, two.cloud_count);
        ASSERT_TRUE(std::equal(one.clouds.begin(), one.clouds.end(), two.clouds.begin()));
        ASSERT_TRUE(std::equal(one.obscurants.begin(), one.obscurants.end(), two.obscurants.begin()));
        ASSERT_EQ(one.wind_m_s, two.wind_m_s);
        ASSERT_EQ(a.scene.air, b.scene.air);
    }
    EXPECT_GT(a.weather().obscurant_count, 4U);
}

TEST(WeatherBuilder, RainSoaksTheLandInMinutesAndItDriesInHalfAnHour) {
    WeatherBench bench;
    bench.frame();
    cigi::WeatherControl rain = cloud(4, CloudType::kNone, 1500.0F, 100.0F);
    rain.thickness = 1500.0F;
    rain.severity = 3;
    bench.send(wind(5.0F, 270.0F), rain);
    const auto wet_after = [&](int seconds) {
        for (int i = 0; i < seconds; ++i)
            bench.frame(1.0);
        return bench.scene.ground.wet;
    };
    const double soon = wet_after(60);
    const double soaked = wet_after(900);
    rain.weather_enable = false;
    bench.send(rain);
    bench.settle();
    const double half_dry = wet_after(1250);
    std::printf("  wet after a minute %.2f, a quarter of an hour %.2f, 21 min after the rain %.2f\n", soon,
                soaked, half_dry);
    EXPECT_GT(soon, 0.05);
    EXPECT_LT(soon, 0.8);
    EXPECT_EQ(soaked, 1.0);
    EXPECT_NEAR(half_dry, 0.5, 0.03);
    // A clock that is set has had its time.
    rain.weather_enable = true;
    bench.send(rain);
    bench.frame(100.0);
    EXPECT_EQ(bench.scene.ground.wet, 1.0);
}

TEST(WeatherBuilder, SnowWhitensTheLandUntilTheHostSaysHowMuchLies) {
    WeatherBench bench;
    WeatherBench replay;
    cigi::AtmosphereControl frost = wind(5.0F, 270.0F);
    frost.air_temperature = -3.0F;
    cigi::WeatherControl snow = cloud(5, CloudType::kNone, 1500.0F, 100.0F);
    snow.thickness = 1500.0F;
    snow.severity = 3;
    cigi::TerrestrialSurfaceControl told;
    told.condition_id = world::kSnowCondition;
    told.enable = true;
    told.coverage = 20;
    double first = 0.0, largest_step = 0.0;
    for (WeatherBench* run : {&bench, &replay}) {
        run->frame();
        EXPECT_EQ(run->scene.ground.snow, 0.0);
        run->send(frost, snow);
        double before = 0.0;
        for (int second = 0; second < 3600; ++second) {
            const double now = run->frame(1.0).ground.snow;
            largest_step = std::max(largest_step, std::abs(now - before));
            before = now;
        }
        if (run == &bench) first = before;
        EXPECT_EQ(before, first) << "the same weather, the same snow";
        run->send(told);
        EXPECT_DOUBLE_EQ(run->frame(1.0).ground.snow, 0.2);
    }
    std::printf("  an hour of snow covers %.2f, by %.1e a second at most\n", first, largest_step);
    EXPECT_GT(first, 0.6);
    EXPECT_LT(largest_step, 1e-3);
    told.condition_id = world::kDryCondition;
    bench.send(told);
    EXPECT_DOUBLE_EQ(bench.frame(1.0).ground.snow, 0.2) << "told beside it";
    told.condition_id = world::kSnowCondition;
    told.enable = false;
    bench.send(told);
    EXPECT_DOUBLE_EQ(bench.frame(1.0).ground.snow, 0.0) << "dry";
    told.condition_id = world::kDryCondition;
    bench.send(told);
    EXPECT_GT(bench.frame(1.0).ground.snow, 0.6) << "what fell meanwhile";
    told.condition_id = world::kWetCondition;
    told.enable = true;
    told.coverage = 70;
    bench.send(told);
    EXPECT_DOUBLE_EQ(bench.frame(1.0).ground.wet, 0.7);
}

/// Least of several rounds of a frame's part.
double frame_us(WeatherBench& bench) {
    WeatherBuilder builder;
    render::Scene scene = bench.scene;
    double least_us = 1e9;
    for (int round = 0; round < 20; ++round) {
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < 20; ++i) {
            scene.weather.cloud_count = scene.weather.obscurant_count = 0;
            scene.weather.precipitation_count = scene.weather.lightning_count = 0;
            scene.time_s += 1.0 / 60.0;
            builder.build(bench.host.world, scene);
        }
        const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
        least_us = std::min(least_us, took.count() / 20.0);
    }
    return least_us;
}

TEST(WeatherBuilder, CostsLittle) {
    WeatherBench bench;
    bench.settle();
    const double none_us = frame_us(bench);
    for (int frame = 0; frame < 100; ++frame) {
        tell(bench, frame);
        bench.frame();
    }
    bench.settle();
    const double busy_us = frame_us(bench);
    for (std::uint16_t id = 0; id < 256; ++id) {
        bench.send(region(id, kLat, kLon + 0.01 * id, 20e3F),
                   in_region(cloud(1, CloudType::kCumulus, 1000.0F, 50.0F), id));
    }
    bench.settle();
    const double full_us = frame_us(bench);
    std::printf("  us a frame: %.2f clear, %.2f with 3 global layers and 8 regions, %.1f with 256 regions\n",
                none_us, busy_us, full_us);
    RecordProperty("weather_us", std::to_string(busy_us));
    EXPECT_LT(busy_us, 200.0) << "far above what it takes, even under a sanitizer";
}

}  // namespace
}  // namespace skyig::server::weather
