#include "server/world/conditions.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <vector>

namespace skyig::server::world {
namespace {

using protocol::cigi::EnvRegionControl;
using protocol::cigi::MaritimeSurfaceControl;
using protocol::cigi::RegionState;
using protocol::cigi::TerrestrialSurfaceControl;
using protocol::cigi::WaveControl;
using protocol::cigi::WeatherControl;
using protocol::cigi::WeatherScope;

/// 1000..2000 m with bands of 100 m below and 400 m above.
WeatherControl layer(WeatherScope scope, int region_id, int layer_id) {
    WeatherControl control;
    control.scope = scope;
    control.entity_region_id = static_cast<std::uint16_t>(region_id);
    control.layer_id = static_cast<std::uint8_t>(layer_id);
    control.weather_enable = true;
    control.visibility = 500.0F;
    control.air_temperature = 5.0F;
    control.humidity = 90;
    control.pressure = 900.0F;
    control.aerosol = 2.0F;
    control.base_elevation = 1000.0F;
    control.thickness = 1000.0F;
    control.transition_band = 100.0F;
    control.top_transition_band = 400.0F;
    return control;
}

EnvRegionControl region(int id, double longitude_deg = 0.0) {
    EnvRegionControl control;
    control.region_id = static_cast<std::uint16_t>(id);
    control.region_state = RegionState::kActive;
    control.longitude = longitude_deg;
    control.size_x = control.size_y = 100'000.0F;
    return control;
}

class ConditionsTest : public ::testing::Test {
  protected:
    [[nodiscard]] RegionsAt regions(double latitude_deg = 0.0, double longitude_deg = 0.0) const {
        return {weather_, GroundPoint(latitude_deg, longitude_deg)};
    }
    [[nodiscard]] AirState air(double height_m, double longitude_deg = 0.0) const {
        return air_at(base_, weather_, regions(0.0, longitude_deg), height_m);
    }

    AirState base_;
    WeatherStore weather_;
    SurfaceStore surfaces_;
};

TEST_F(ConditionsTest, BaseStateWhereNoLayerIs) {
    base_.visibility_m = 12'345.678;
    base_.wind_horizontal_m_s = 7.0;
    base_.wind_from_deg = 359.9;
    ASSERT_TRUE(weather_.set(layer(WeatherScope::kGlobal, 0, 1)));
    const AirState here = air(0.0);
    EXPECT_EQ(here.visibility_m, base_.visibility_m);
    EXPECT_EQ(here.wind_from_deg, base_.wind_from_deg);
    EXPECT_EQ(here.temperature_c, base_.temperature_c);
}

TEST_F(ConditionsTest, LayerHoldsBetweenItsEdgesAndFadesInItsBands) {
    ASSERT_TRUE(weather_.set(layer(WeatherScope::kGlobal, 0, 1)));
    for (const double height_m : {1000.0, 1500.0, 2000.0}) {
        EXPECT_NEAR(air(height_m).visibility_m, 500.0, 1e-9);
        EXPECT_NEAR(air(height_m).temperature_c, 5.0, 1e-12);
        EXPECT_NEAR(air(height_m).humidity_pct, 90.0, 1e-12);
        EXPECT_NEAR(air(height_m).pressure_hpa, 900.0, 1e-9);
    }
    EXPECT_NEAR(air(950.0).temperature_c, 10.0, 1e-12);
    EXPECT_NEAR(air(2100.0).temperature_c, 7.5, 1e-12);
    // Extinctions are what fades: half of 1/500 and half of 1/80000.
    EXPECT_NEAR(air(950.0).visibility_m, 1.0 / (0.5 / 500.0 + 0.5 / 80'000.0), 1e-6);
    EXPECT_EQ(air(899.9).visibility_m, base_.visibility_m);
    EXPECT_EQ(air(2400.1).visibility_m, base_.visibility_m);
}

TEST_F(ConditionsTest, LayerWithoutThicknessOrBandHasItsHeightAlone) {
    WeatherControl thin = layer(WeatherScope::kGlobal, 0, 1);
    thin.thickness = thin.transition_band = thin.top_transition_band = 0.0F;
    EXPECT_EQ(layer_weight(thin, 1000.0), 1.0);
    EXPECT_EQ(layer_weight(thin, 1000.001), 0.0);
    EXPECT_EQ(layer_weight(thin, 999.999), 0.0);
}

TEST_F(ConditionsTest, LayersTogetherAddExtinctionAndAverageTheRest) {
    WeatherControl a = layer(WeatherScope::kGlobal, 0, 1);
    WeatherControl b = layer(WeatherScope::kGlobal, 0, 4);
    a.wind_horizontal = 10.0F;
    a.wind_direction = 350.0F;
    b.wind_horizontal = 10.0F;
    b.wind_direction = 10.0F;
    b.visibility = 1000.0F;
    b.air_temperature = 9.0F;
    ASSERT_TRUE(weather_.set(a) && weather_.set(b));
    const AirState here = air(1500.0);
    EXPECT_NEAR(here.visibility_m, 1.0 / (1.0 / 500.0 + 1.0 / 1000.0), 1e-9);
    EXPECT_NEAR(here.temperature_c, 7.0, 1e-12);
    EXPECT_NEAR(std::remainder(here.wind_from_deg, 360.0), 0.0, 1e-9);
    EXPECT_NEAR(here.wind_horizontal_m_s, 10.0 * std::cos(10.0 * 3.14159265358979323846 / 180.0), 1e-9);
    // Opposite winds cancel.
    b.wind_direction = 170.0F;
    ASSERT_TRUE(weather_.set(b));
    EXPECT_NEAR(air(1500.0).wind_horizontal_m_s, 0.0, 1e-9);
}

TEST_F(ConditionsTest, ALayerWithoutWindHasThatOfTheBaseState) {
    base_.wind_horizontal_m_s = 12.0;
    base_.wind_from_deg = 90.0;
    WeatherControl still = layer(WeatherScope::kGlobal, 0, 1);
    still.wind_horizontal = 0.0F;
    ASSERT_TRUE(weather_.set(still));
    EXPECT_NEAR(air(1500.0).wind_horizontal_m_s, 12.0, 1e-9);
    EXPECT_NEAR(air(1500.0).wind_from_deg, 90.0, 1e-9);
}

TEST_F(ConditionsTest, SwitchedOffLayersDoNotCount) {
    WeatherControl off = layer(WeatherScope::kGlobal, 0, 1);
    off.weather_enable = false;
    ASSERT_TRUE(weather_.set(off));
    EXPECT_EQ(air(1500.0).visibility_m, base_.visibility_m);
    EXPECT_TRUE(weather_.enable_layer(WeatherScope::kGlobal, 0, 1, true));
    EXPECT_NEAR(air(1500.0).visibility_m, 500.0, 1e-9);
    EXPECT_FALSE(weather_.enable_layer(WeatherScope::kGlobal, 0, 2, true));
}

TEST_F(ConditionsTest, NoSightAndEndlessSightStayFinite) {
    WeatherControl dense = layer(WeatherScope::kGlobal, 0, 1);
    dense.visibility = 0.0F;
    ASSERT_TRUE(weather_.set(dense));
    EXPECT_EQ(air(1500.0).visibility_m, 0.0);
    EXPECT_GT(air(950.0).visibility_m, 0.0);
    dense.visibility = 3.4e38F;
    base_.visibility_m = 3.4e38;
    ASSERT_TRUE(weather_.set(dense));
    EXPECT_NEAR(air(950.0).visibility_m / 3.4e38, 1.0, 1e-6);
}

TEST_F(ConditionsTest, RegionalCoversGlobalAndFadesInThePerimeter) {
    WeatherControl regional = layer(WeatherScope::kRegional, 7, 1);
    regional.air_temperature = -20.0F;
    EnvRegionControl area = region(7);
    area.transition_perimeter = 50'000.0F;
    ASSERT_TRUE(weather_.set(layer(WeatherScope::kGlobal, 0, 1)) && weather_.set(regional) &&
                weather_.set(area));
    EXPECT_NEAR(air(1500.0).temperature_c, -20.0, 1e-12);
    // 75 km east of the centre: half way through the perimeter.
    EXPECT_NEAR(air(1500.0, 75'000.0 / 111'319.4908).temperature_c, -7.5, 1e-4);
    EXPECT_NEAR(air(1500.0, 2.0).temperature_c, 5.0, 1e-12);
    ASSERT_TRUE(weather_.enable_region(7, false));
    EXPECT_NEAR(air(1500.0).temperature_c, 5.0, 1e-12);
}

TEST_F(ConditionsTest, LastSentRegionWinsUnlessItMerges) {
    WeatherControl first = layer(WeatherScope::kRegional, 9, 1);
    WeatherControl second = layer(WeatherScope::kRegional, 2, 1);
    first.air_temperature = 0.0F;
    second.air_temperature = 20.0F;
    EnvRegionControl of_first = region(9);
    EnvRegionControl of_second = region(2, 0.1);
    ASSERT_TRUE(weather_.set(first) && weather_.set(second));
    // The order of sending counts, not that of ids.
    ASSERT_TRUE(weather_.set(of_first) && weather_.set(of_second));
    EXPECT_NEAR(air(1500.0).temperature_c, 20.0, 1e-12);
    ASSERT_TRUE(weather_.set(of_first));
    EXPECT_NEAR(air(1500.0).temperature_c, 0.0, 1e-12);
    of_second.merge_weather = true;
    ASSERT_TRUE(weather_.set(of_second));
    EXPECT_NEAR(air(1500.0).temperature_c, 10.0, 1e-12);
    EXPECT_NEAR(air(1500.0).visibility_m, 250.0, 1e-9);
    // A region without layers here covers nothing.
    ASSERT_TRUE(weather_.set(region(300)));
    EXPECT_NEAR(air(1500.0).temperature_c, 10.0, 1e-12);
}

TEST_F(ConditionsTest, AerosolOfTheSameLayerIsAveragedWhereRegionsMerge) {
    WeatherControl first = layer(WeatherScope::kRegional, 1, 9);
    WeatherControl second = layer(WeatherScope::kRegional, 2, 9);
    first.aerosol = 1.0F;
    second.aerosol = 4.0F;
    EnvRegionControl of_second = region(2);
    ASSERT_TRUE(weather_.set(layer(WeatherScope::kGlobal, 0, 9)) &&
                weather_.set(layer(WeatherScope::kGlobal, 0, 4)) && weather_.set(first) &&
                weather_.set(second) && weather_.set(region(1)) && weather_.set(of_second));
    const auto at = [this](double height_m) { return aerosols_at(weather_, regions(), height_m).layers; };
    EXPECT_NEAR(at(1500.0)[9].aerosol_g_m3, 4.0, 1e-12);
    EXPECT_NEAR(at(1500.0)[4].aerosol_g_m3, 2.0, 1e-12);
    EXPECT_FALSE(at(1500.0)[5].present);
    EXPECT_FALSE(at(100.0)[9].present);
    of_second.merge_aerosol = true;
    ASSERT_TRUE(weather_.set(of_second));
    EXPECT_NEAR(at(1500.0)[9].aerosol_g_m3, 2.5, 1e-12);
    // In the band below: half of it.
    EXPECT_NEAR(at(950.0)[4].aerosol_g_m3, 1.0, 1e-12);
}

MaritimeSurfaceControl sea(WeatherScope scope, int region_id, float height_m) {
    MaritimeSurfaceControl control;
    control.scope = scope;
    control.entity_region_id = static_cast<std::uint16_t>(region_id);
    control.enable = true;
    control.sea_surface_height = height_m;
    control.water_temperature = 4.0F;
    control.clarity = 30.0F;
    return control;
}

TEST_F(ConditionsTest, SeaIsTheRegionsOverTheGlobalOverTheEllipsoid) {
    EXPECT_EQ(sea_at(surfaces_, regions()).height_m, 0.0);
    EXPECT_EQ(sea_at(surfaces_, regions()).temperature_c, 15.0);
    ASSERT_TRUE(surfaces_.set(sea(WeatherScope::kGlobal, 77, 3.0F)));
    EXPECT_NEAR(sea_at(surfaces_, regions()).height_m, 3.0, 1e-12);
    EXPECT_FALSE(surfaces_.has_regional_sea());
    ASSERT_TRUE(surfaces_.set(sea(WeatherScope::kRegional, 1, 5.0F)));
    ASSERT_TRUE(surfaces_.set(sea(WeatherScope::kRegional, 2, 9.0F)));
    EXPECT_TRUE(surfaces_.has_regional_sea());
    EXPECT_NEAR(sea_at(surfaces_, regions()).height_m, 3.0, 1e-12) << "regions 1 and 2 do not exist";
    EnvRegionControl second = region(2);
    ASSERT_TRUE(weather_.set(region(1)) && weather_.set(second));
    EXPECT_NEAR(sea_at(surfaces_, regions()).height_m, 9.0, 1e-12);
    second.merge_maritime = true;
    ASSERT_TRUE(weather_.set(second));
    EXPECT_NEAR(sea_at(surfaces_, regions()).height_m, 7.0, 1e-12);
    EXPECT_NEAR(sea_at(surfaces_, regions()).clarity_pct, 30.0, 1e-12);
    surfaces_.forget_region(2);
    EXPECT_NEAR(sea_at(surfaces_, regions()).height_m, 5.0, 1e-12);
    surfaces_.clear();
    EXPECT_EQ(sea_at(surfaces_, regions()).height_m, 0.0);
}

TerrestrialSurfaceControl ground(WeatherScope scope, int region_id, int condition_id) {
    TerrestrialSurfaceControl control;
    control.scope = scope;
    control.entity_region_id = static_cast<std::uint16_t>(region_id);
    control.condition_id = static_cast<std::uint16_t>(condition_id);
    control.enable = true;
    return control;
}

TEST_F(ConditionsTest, WeatherOnAnEntityFadesWithTheDistanceAndLiesOverAll) {
    WeatherControl storm = layer(WeatherScope::kEntity, 12, 200);
    storm.base_elevation = 9e5F;  // means nothing
    storm.thickness = 0.0F;
    storm.transition_band = 5000.0F;
    storm.humidity = 100;
    const auto with = [&](double distance_m) {
        CarriedAt carried;
        carried.add(storm, distance_m);
        return air_at(base_, weather_, regions(), 0.0, carried.all());
    };
    EXPECT_NEAR(with(0.0).visibility_m, 500.0, 1e-9);
    EXPECT_NEAR(with(0.0).temperature_c, 5.0, 1e-12);
    // Half way: half of each extinction, of each temperature.
    EXPECT_NEAR(1.0 / with(2500.0).visibility_m, 0.5 / 500.0 + 0.5 / 80'000.0, 1e-12);
    EXPECT_NEAR(with(2500.0).humidity_pct, 75.0, 1e-9);
    EXPECT_EQ(with(5000.0).visibility_m, base_.visibility_m);
    EXPECT_EQ(with(5000.0).temperature_c, base_.temperature_c);
    // Over a region's fog as over the base state.
    WeatherControl fog = layer(WeatherScope::kRegional, 3, 0);
    fog.base_elevation = 0.0F;
    fog.visibility = 50.0F;
    ASSERT_TRUE(weather_.set(region(3)) && weather_.set(fog));
    EXPECT_NEAR(with(0.0).visibility_m, 500.0, 1e-9);
    EXPECT_NEAR(with(1e9).visibility_m, 50.0, 1e-9);
    // Two entities count together.
    WeatherControl other = storm;
    other.air_temperature = 15.0F;
    CarriedAt both;
    both.add(storm, 0.0);
    both.add(other, 0.0);
    const AirState air = air_at(base_, weather_, regions(), 0.0, both.all());
    EXPECT_NEAR(air.visibility_m, 250.0, 1e-9);
    EXPECT_NEAR(air.temperature_c, 10.0, 1e-9);
    for (std::size_t i = 0; i < 2 * CarriedAt::kMost; ++i)
        both.add(other, 0.0);
    EXPECT_EQ(both.all().size(), CarriedAt::kMost);
}

WaveControl wave(WeatherScope scope, int region_id, int wave_id, float height_m) {
    WaveControl control;
    control.scope = scope;
    control.entity_region_id = static_cast<std::uint16_t>(region_id);
    control.wave_id = static_cast<std::uint8_t>(wave_id);
    control.wave_enable = true;
    control.height = height_m;
    return control;
}

TEST_F(ConditionsTest, SnowIsConditionOneTheRegionsOverTheGlobal) {
    const auto snow = [](WeatherScope scope, int region_id, int coverage, int condition_id) {
        protocol::cigi::TerrestrialSurfaceControl control;
        control.scope = scope;
        control.entity_region_id = static_cast<std::uint16_t>(region_id);
        control.condition_id = static_cast<std::uint16_t>(condition_id);
        control.enable = true;
        control.coverage = static_cast<std::uint8_t>(coverage);
        return control;
    };
    EXPECT_FALSE(condition_cover(surfaces_, regions(), kSnowCondition));
    ASSERT_TRUE(surfaces_.set(snow(WeatherScope::kGlobal, 0, 90, kWetCondition)));
    EXPECT_FALSE(condition_cover(surfaces_, regions(), kSnowCondition)) << "another condition";
    ASSERT_TRUE(surfaces_.set(snow(WeatherScope::kGlobal, 0, 40, kSnowCondition)));
    EXPECT_DOUBLE_EQ(condition_cover(surfaces_, regions(), kSnowCondition).value(), 0.4);
    ASSERT_TRUE(weather_.set(region(3)));
    ASSERT_TRUE(surfaces_.set(snow(WeatherScope::kRegional, 3, 100, kSnowCondition)));
    EXPECT_TRUE(surfaces_.is_regional());
    EXPECT_DOUBLE_EQ(condition_cover(surfaces_, regions(), kSnowCondition).value(), 1.0);
    auto off = snow(WeatherScope::kGlobal, 0, 40, kSnowCondition);
    off.enable = false;
    ASSERT_TRUE(surfaces_.set(off));
    EXPECT_FALSE(condition_cover(surfaces_, RegionsAt(), kSnowCondition));
    ASSERT_TRUE(surfaces_.set(snow(WeatherScope::kGlobal, 0, 0, kDryCondition)));
    EXPECT_DOUBLE_EQ(condition_cover(surfaces_, RegionsAt(), kSnowCondition).value(), 0.0) << "dry is bare";
    EXPECT_DOUBLE_EQ(condition_cover(surfaces_, RegionsAt(), kWetCondition).value(), 0.9)
        << "what is told beside it";
}

TEST_F(ConditionsTest, WavesAreTheRegionsOverTheGlobal) {
    const auto heights = [this](double longitude_deg) {
        std::vector<double> all;
        for (const WaveAt& at : WavesAt(surfaces_, regions(0.0, longitude_deg)))
            all.push_back(static_cast<double>(at.wave->height) * at.weight);
        return all;
    };
    EXPECT_TRUE(heights(0.0).empty());
    ASSERT_TRUE(surfaces_.set(wave(WeatherScope::kGlobal, 0, 1, 4.0F)));
    ASSERT_TRUE(surfaces_.set(wave(WeatherScope::kGlobal, 9, 2, 1.0F))) << "a global one has no region";
    EXPECT_EQ(heights(0.0), (std::vector<double>{4.0, 1.0}));
    EXPECT_FALSE(surfaces_.is_regional());
    ASSERT_TRUE(surfaces_.set(wave(WeatherScope::kRegional, 3, 1, 0.5F)));
    EXPECT_TRUE(surfaces_.is_regional());
    EXPECT_EQ(heights(0.0).size(), 2U) << "a region that nobody has defined";
    EnvRegionControl lake = region(3);
    lake.transition_perimeter = 20'000.0F;
    ASSERT_TRUE(weather_.set(lake));
    EXPECT_EQ(heights(0.0), (std::vector<double>{0.5}));
    // In the perimeter by part.
    const double shore_deg = 60'000.0 / 111'319.49;
    const std::vector<double> shore = heights(shore_deg);
    ASSERT_EQ(shore.size(), 3U);
    EXPECT_NEAR(shore[0], 2.0, 1e-4);
    EXPECT_NEAR(shore[1], 0.5, 1e-4);
    EXPECT_NEAR(shore[2], 0.25, 1e-4);
    // The first region covers the global ones whatever its flag; the next joins it with its own.
    EnvRegionControl bay = region(4);
    bay.merge_maritime = true;
    ASSERT_TRUE(weather_.set(bay) && surfaces_.set(wave(WeatherScope::kRegional, 4, 7, 3.0F)));
    EXPECT_EQ(heights(0.0), (std::vector<double>{0.5, 3.0}));
    bay.merge_maritime = false;
    ASSERT_TRUE(weather_.set(bay));
    EXPECT_EQ(heights(0.0), (std::vector<double>{3.0}));
    WaveControl off = wave(WeatherScope::kRegional, 4, 7, 3.0F);
    off.wave_enable = false;
    ASSERT_TRUE(surfaces_.set(off));
    EXPECT_EQ(heights(0.0), (std::vector<double>{0.5}));
    surfaces_.forget_region(3);
    EXPECT_EQ(heights(0.0).size(), 2U);
}

TEST_F(ConditionsTest, OfManyWavesTheHighestAreKept) {
    for (int id = 0; id < 40; ++id)
        ASSERT_TRUE(surfaces_.set(wave(WeatherScope::kGlobal, 0, id, static_cast<float>((id * 7) % 40))));
    const WavesAt waves(surfaces_, {});
    ASSERT_EQ(waves.size(), WavesAt::kMost);
    for (const WaveAt& at : waves)
        EXPECT_GE(at.wave->height, 24.0F);
    std::size_t stored = 40;
    for (int id = 0; id < 2000; ++id)
        stored += surfaces_.set(wave(WeatherScope::kRegional, id, 0, 1.0F)) ? 1U : 0U;
    EXPECT_EQ(stored, SurfaceStore::kMaxWaves);
}

TEST_F(ConditionsTest, GroundIsDryUnlessAConditionIsSet) {
    const auto ids = [this](double longitude_deg = 0.0) {
        const GroundConditions conditions(surfaces_, regions(0.0, longitude_deg));
        return std::vector<int>(conditions.begin(), conditions.end());
    };
    using Ids = std::vector<int>;
    EXPECT_EQ(ids(), Ids{0});
    ASSERT_TRUE(surfaces_.set(ground(WeatherScope::kGlobal, 0, 3)) &&
                surfaces_.set(ground(WeatherScope::kGlobal, 0, 1)));
    EXPECT_EQ(ids(), (Ids{1, 3}));
    EnvRegionControl area = region(5);
    area.transition_perimeter = 50'000.0F;
    ASSERT_TRUE(weather_.set(area) && surfaces_.set(ground(WeatherScope::kRegional, 5, 65535)));
    EXPECT_EQ(ids(), Ids{65535});
    EXPECT_EQ(ids(0.7), (Ids{1, 3, 65535})) << "in the perimeter both are met";
    EnvRegionControl other = region(6);
    other.merge_terrestrial = true;
    ASSERT_TRUE(weather_.set(other) && surfaces_.set(ground(WeatherScope::kRegional, 6, 2)));
    EXPECT_EQ(ids(), (Ids{65535, 2}));
    other.merge_terrestrial = false;
    ASSERT_TRUE(weather_.set(other));
    EXPECT_EQ(ids(), Ids{2});
    TerrestrialSurfaceControl off = ground(WeatherScope::kRegional, 6, 2);
    off.enable = false;
    ASSERT_TRUE(surfaces_.set(off));
    EXPECT_EQ(ids(), Ids{65535});
}

TEST_F(ConditionsTest, StoresThatAreFullTakeWhatTheyHave) {
    for (std::size_t i = 0; i < SurfaceStore::kMaxConditions; ++i)
        ASSERT_TRUE(surfaces_.set(ground(WeatherScope::kRegional, 1, static_cast<int>(i))));
    EXPECT_FALSE(surfaces_.set(ground(WeatherScope::kRegional, 2, 1)));
    EXPECT_TRUE(surfaces_.set(ground(WeatherScope::kRegional, 1, 1)));
    ASSERT_TRUE(weather_.set(region(1)));
    EXPECT_EQ(GroundConditions(surfaces_, regions()).size(), GroundConditions::kMost);
    for (std::size_t i = 0; i < SurfaceStore::kMaxSeas; ++i)
        ASSERT_TRUE(surfaces_.set(sea(WeatherScope::kRegional, static_cast<int>(i), 1.0F)));
    EXPECT_FALSE(surfaces_.set(sea(WeatherScope::kRegional, 1000, 1.0F)));
    surfaces_.forget_region(1);
    EXPECT_TRUE(surfaces_.set(sea(WeatherScope::kRegional, 1000, 1.0F)));
    EXPECT_TRUE(surfaces_.conditions(WeatherScope::kRegional, 1).empty());
}

/// Every region has the point inside: the most that one request can cost.
TEST_F(ConditionsTest, CostOfAPointInAllRegions) {
    for (int i = 0; i < static_cast<int>(WeatherStore::kMaxRegions); ++i) {
        ASSERT_TRUE(weather_.set(region(i, 0.0001 * i)));
        for (int k = 0; k < 8; ++k)
            ASSERT_TRUE(weather_.set(layer(WeatherScope::kRegional, i, k)));
    }
    const auto time_us = [this](double longitude_deg, std::size_t& inside) {
        constexpr int kRepeats = 50;
        double sum = 0.0;
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < kRepeats; ++i) {
            const RegionsAt at = regions(0.1, longitude_deg);
            sum += air_at(base_, weather_, at, 1500.0).temperature_c;
            sum += aerosols_at(weather_, at, 1500.0).layers[3].aerosol_g_m3;
            inside = at.size();
        }
        EXPECT_GT(sum, 0.0);
        return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count() /
               kRepeats;
    };
    std::size_t inside = 0;
    const double worst_us = time_us(0.0, inside);
    EXPECT_EQ(inside, WeatherStore::kMaxRegions);
    const double far_us = time_us(90.0, inside);
    EXPECT_EQ(inside, 0U);
    std::printf("  256 regions of 8 layers: %.0f us where all hold the point, %.0f us far from all\n",
                worst_us, far_us);
    RecordProperty("worst_us", std::to_string(worst_us));
    EXPECT_LT(worst_us, 20'000.0);
}

}  // namespace
}  // namespace skyig::server::world
