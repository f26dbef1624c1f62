#include "server/weather/drifts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "server/start_weather/layers.h"
#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

using cigi::CloudType;

cigi::AtmosphereControl wind(float speed_m_s, float from_deg) {
    cigi::AtmosphereControl air;
    air.model_enable = true;
    air.visibility = 50'000.0F;
    air.wind_horizontal = speed_m_s;
    air.wind_direction = from_deg;
    return air;
}

TEST(Drift, IsExactOverADayAndGoesOnWhenTheWindTurns) {
    Drift drift;
    const glm::dvec2 west{12.3, -4.5};
    drift.set_wind(west, 100.0);
    EXPECT_EQ(drift.at(0.0), glm::dvec2(0.0)) << "the first wind has blown since scene time 0";
    double worst_m = 0.0;
    for (int frame = 6000; frame < 86400 * 60; frame += 977) {
        const double time_s = frame / 60.0;
        drift.set_wind(west, time_s);
        worst_m = std::max(worst_m, glm::distance(drift.at(time_s), west * time_s));
    }
    EXPECT_EQ(worst_m, 0.0);
    const glm::dvec2 before = drift.at(86400.0);
    drift.set_wind({-20.0, 0.0}, 86400.0);
    EXPECT_EQ(drift.at(86400.0), before);
    EXPECT_NEAR(drift.at(86410.0).x, before.x - 200.0, 1e-6);
}

/// A turn of the wind, then a while without the layer or with another genus: where it would have been.
TEST(Drifts, ALayerThatComesBackIsWhereItWouldHaveBeen) {
    WeatherBench stays, comes, late;
    const cigi::WeatherControl cumulus = cloud(1, CloudType::kCumulus, 1000.0F, 50.0F);
    cigi::WeatherControl off = cumulus;
    off.weather_enable = false;
    const auto frames = [&](int count) {
        for (int i = 0; i < count; ++i) {
            stays.frame(1.0);
            comes.frame(1.0);
            late.frame(1.0);
        }
    };
    const auto send = [&](const auto& packet) {
        stays.send(packet);
        comes.send(packet);
        late.send(packet);
    };
    send(wind(10.0F, 270.0F));
    stays.send(cumulus);
    comes.send(cumulus);
    frames(600);
    comes.send(off);
    frames(60);
    ASSERT_EQ(comes.weather().cloud_count, 0U);
    send(wind(20.0F, 0.0F));
    frames(60);
    comes.send(cumulus);
    late.send(cumulus);
    frames(20);
    const glm::dvec2 there = stays.weather().clouds[0].drift_m;
    EXPECT_GT(there.x, 10'000.0);
    EXPECT_LT(glm::distance(comes.weather().clouds[0].drift_m, there), 1e-6);
    EXPECT_LT(glm::distance(late.weather().clouds[0].drift_m, there), 1e-6) << "told for the first time";
    // Another genus in its place goes on with it.
    comes.send(cloud(1, CloudType::kStratus, 1000.0F, 100.0F));
    frames(5);
    ASSERT_EQ(comes.weather().cloud_count, 2U);
    for (const render::CloudLayer& cloud : comes.weather().all_clouds())
        EXPECT_LT(glm::distance(cloud.drift_m, stays.weather().clouds[0].drift_m), 1e-6);
}

TEST(Drifts, AnotherCarrierGoesOnFromWhereTheLayerIs) {
    Drifts drifts;
    drifts.set_air({10.0, 0.0}, 100.0);
    drifts.carry(7, {{}, 1.5});
    EXPECT_EQ(drifts.at(7), glm::dvec2(1500.0, 0.0));
    EXPECT_EQ(drifts.at(8), glm::dvec2(0.0)) << "never told";
    drifts.carry(7, {glm::dvec2{0.0, 30.0}, 1.5});
    EXPECT_EQ(drifts.at(7), glm::dvec2(1500.0, 0.0));
    drifts.set_air({10.0, 0.0}, 110.0);
    EXPECT_EQ(drifts.at(7), glm::dvec2(1500.0, 300.0));
    drifts.forget();
    drifts.set_air({1.0, 0.0}, 120.0);
    drifts.carry(7, {{}, 1.0});
    EXPECT_EQ(drifts.at(7), glm::dvec2(120.0, 0.0)) << "as at a start";
}

TEST(Drifts, OfMorePlacesThanThereIsRoomTheLongestUntoldAreForgotten) {
    Drifts drifts;
    const Carrier first{glm::dvec2{1.0, 0.0}, 1.0}, second{glm::dvec2{2.0, 0.0}, 1.0};
    drifts.set_air({}, 10.0);
    for (std::uint32_t place = 0; place < Drifts::kMost; ++place)
        drifts.carry(place, first);
    drifts.set_air({}, 20.0);
    for (std::uint32_t place = 1; place < Drifts::kMost; ++place)
        drifts.carry(place, second);
    drifts.carry(9999, second);
    EXPECT_EQ(drifts.at(0), glm::dvec2(0.0));
    EXPECT_EQ(drifts.at(1), glm::dvec2(20.0, 0.0)) << "goes on from where it was";
    EXPECT_EQ(drifts.at(9999), glm::dvec2(40.0, 0.0));
}

}  // namespace
}  // namespace skyig::server::weather
