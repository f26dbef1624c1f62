#include "server/weather/told_layer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "render/precipitation/extinction.h"
#include "server/start_weather/precipitation.h"
#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

using cigi::CloudType;
using cigi::WeatherControl;
using render::CloudGenus;
using render::Obscurant;
using render::Precipitation;

WeatherControl layer(int id) {
    WeatherControl made = cloud(static_cast<std::uint8_t>(id), CloudType::kNone, 0.0F, 100.0F);
    made.visibility = 2000.0F;
    return made;
}

TEST(ToldLayer, EveryLayerIdIsWhatTheTableSays) {
    struct Row {
        int id;
        Family family;
        int kind;
    };
    const std::array rows{
        Row{0, Family::kObscurant, static_cast<int>(Obscurant::Kind::kFog)},
        Row{4, Family::kFalling, static_cast<int>(Precipitation::Kind::kRain)},
        Row{5, Family::kFalling, static_cast<int>(Precipitation::Kind::kSnow)},
        Row{6, Family::kFalling, static_cast<int>(Precipitation::Kind::kSleet)},
        Row{7, Family::kFalling, static_cast<int>(Precipitation::Kind::kHail)},
        Row{8, Family::kObscurant, static_cast<int>(Obscurant::Kind::kSand)},
        Row{9, Family::kObscurant, static_cast<int>(Obscurant::Kind::kDust)},
        Row{10, Family::kFalling, static_cast<int>(Precipitation::Kind::kDrizzle)},
        Row{11, Family::kObscurant, static_cast<int>(Obscurant::Kind::kSmoke)},
        Row{12, Family::kObscurant, static_cast<int>(Obscurant::Kind::kHaze)},
    };
    for (const Row& row : rows) {
        const auto told = told_layer(layer(row.id), {});
        ASSERT_TRUE(told) << row.id;
        EXPECT_EQ(told->key.family, row.family) << row.id;
        EXPECT_EQ(told->key.kind, row.kind) << row.id;
        EXPECT_NEAR(told->state.extinction_per_m, -std::log(0.05) / 2000.0, 1e-12) << row.id;
    }
    for (const int id : {1, 2, 3, 10, 11, 12, 13, 14, 255}) {
        for (int type = 1; type <= 10; ++type) {
            WeatherControl made = layer(id);
            made.cloud_type = static_cast<CloudType>(type);
            const auto told = told_layer(made, {});
            ASSERT_TRUE(told);
            EXPECT_EQ(told->key.family, Family::kCloud);
            EXPECT_EQ(told->key.kind, type);
        }
    }
    EXPECT_FALSE(told_layer(layer(13), {})) << "an own layer of no known kind";
    EXPECT_FALSE(told_layer(layer(200), {}));
}

TEST(ToldLayer, ACloudWithoutTypeGoesByHeightAboveTheGroundAndAmount) {
    const auto genus = [](float base_m, float coverage_pct, int type = 0) {
        return static_cast<CloudGenus>(
            told_layer(cloud(1, static_cast<CloudType>(type), base_m, coverage_pct),
                       {0.0, 0.05, 1000.0, 15.0})
                ->key.kind);
    };
    EXPECT_EQ(genus(1300.0F, 100.0F), CloudGenus::kStratus);
    EXPECT_EQ(genus(1300.0F, 25.0F), CloudGenus::kCumulus);
    EXPECT_EQ(genus(2300.0F, 75.0F), CloudGenus::kStratocumulus);
    EXPECT_EQ(genus(4000.0F, 75.0F), CloudGenus::kAltocumulus);
    EXPECT_EQ(genus(4000.0F, 100.0F), CloudGenus::kAltostratus);
    EXPECT_EQ(genus(9000.0F, 25.0F), CloudGenus::kCirrus);
    EXPECT_EQ(genus(9000.0F, 100.0F, 15), CloudGenus::kCirrostratus) << "types beyond stratus are as none";
}

TEST(ToldLayer, NothingIsMadeOfALayerWithoutThicknessOrCoverage) {
    WeatherControl flat = cloud(1, CloudType::kCumulus, 1000.0F, 50.0F);
    flat.thickness = 0.0F;
    EXPECT_FALSE(told_layer(flat, {}));
    EXPECT_FALSE(told_layer(cloud(1, CloudType::kCumulus, 1000.0F, 0.0F), {}));
}

TEST(ToldLayer, KeepsBandsScudSeverityAndLightning) {
    WeatherControl told = cloud(2, CloudType::kCumulonimbus, 600.0F, 75.0F);
    told.transition_band = 900.0F;
    told.top_transition_band = 40.0F;
    told.scud_enable = true;
    told.scud_frequency = 30.0F;
    told.top_scud_frequency = 70.0F;
    told.severity = 5;
    told.random_lightning = true;
    const LayerState state = told_layer(told, {})->state;
    EXPECT_DOUBLE_EQ(state.bottom_band_m, 900.0) << "thicker than the layer: it lies outside";
    EXPECT_DOUBLE_EQ(state.top_band_m, 40.0);
    EXPECT_NEAR(state.bottom_scud, 0.3, 1e-6);
    EXPECT_EQ(state.top_scud, 0.0) << "not switched on";
    EXPECT_DOUBLE_EQ(state.severity, 1.0);
    EXPECT_GT(state.flashes_per_min, 0.0);
    EXPECT_NEAR(state.extinction_per_m, 0.06, 1e-6) << "without a visibility: that of a cumulonimbus";
    told.visibility = 60.0F;
    EXPECT_NEAR(told_layer(told, {})->state.extinction_per_m, -std::log(0.05) / 60.0, 1e-9);
    EXPECT_NEAR(told_layer(told, {0.0, 0.02, 0.0, 15.0})->state.extinction_per_m, -std::log(0.02) / 60.0,
                1e-9);
}

TEST(ToldLayer, VisibilityOfAnObscurantHasTheAirInIt) {
    const double air_per_m = -std::log(0.05) / 10'000.0;
    const auto fog = told_layer(layer(0), {air_per_m, 0.05, 0.0, 15.0});
    EXPECT_NEAR(fog->state.extinction_per_m + air_per_m, -std::log(0.05) / 2000.0, 1e-12);
    EXPECT_EQ(told_layer(layer(0), {1.0, 0.05, 0.0, 15.0})->state.extinction_per_m, 0.0);
    WeatherControl blind = layer(0);
    blind.visibility = 0.0F;
    EXPECT_TRUE(std::isfinite(told_layer(blind, {})->state.extinction_per_m));
    EXPECT_GT(told_layer(blind, {})->state.extinction_per_m, 0.5);
    blind.aerosol = 0.1F;
    EXPECT_NEAR(told_layer(blind, {})->state.extinction_per_m, 0.021, 1e-6) << "0.1 g/m3 of fog";
}

TEST(ToldLayer, RateComesFromWaterElseFromSeverityAndCoverage) {
    WeatherControl rain = layer(4);
    const std::array<double, 6> rates{0.3, 1.0, 5.0, 15.0, 30.0, 50.0};
    for (int severity = 0; severity <= 5; ++severity) {
        rain.severity = static_cast<std::uint8_t>(severity);
        EXPECT_NEAR(told_layer(rain, {})->state.rate_mm_h, rates[static_cast<std::size_t>(severity)], 1e-12);
    }
    rain.coverage = 50.0F;
    EXPECT_NEAR(told_layer(rain, {})->state.rate_mm_h, 25.0, 1e-9);
    rain.coverage = 100.0F;
    rain.aerosol = static_cast<float>(water_g_m3(12.5));
    EXPECT_NEAR(told_layer(rain, {})->state.rate_mm_h, 12.5, 1e-4);
    rain.visibility = 0.0F;
    EXPECT_NEAR(told_layer(rain, {})->state.extinction_per_m,
                render::precipitation::rain_extinction_per_m(12.5), 1e-8);
}

TEST(Precipitation, WaterAndRateGoBothWays) {
    // 0.0889 R^0.84 g/m3, from the exponential's fourth moment.
    EXPECT_NEAR(water_g_m3(10.0), 0.0889 * std::pow(10.0, 0.84), 1e-3);
    for (const double rate : {0.1, 1.0, 50.0})
        EXPECT_NEAR(rate_of_water_mm_h(water_g_m3(rate)), rate, 1e-12 * rate);
}

}  // namespace
}  // namespace skyig::server::weather
