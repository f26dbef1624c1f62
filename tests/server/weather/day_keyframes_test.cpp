#include "server/weather/day_keyframes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/config/texts.h"
#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

/// Sets that tell which they are: red = number, fog ends at 1000 m (number + 1) / 0.95.
config::Keyframes numbered() {
    config::Keyframes keyframes;
    for (std::size_t i = 0; i < 8; ++i) {
        const auto number = static_cast<double>(i);
        for (config::Keyframe* set : {&keyframes.good_day[i], &keyframes.bad_day[i]}) {
            *set = {};
            set->sky_colour = {number, 0.0, 0.0};
            set->sky_fog_near_m = 0.0;
            set->sky_fog_far_m = 1000.0 * (number + 1.0) / 0.95;
        }
        keyframes.bad_day[i].sky_colour[1] = 1.0;
    }
    return keyframes;
}

TEST(DayKeyframes, StandOnTheirSetsAndGoLinearlyBetweenThem) {
    const config::Keyframes keyframes = numbered();
    for (int i = 0; i < 8; ++i) {
        EXPECT_NEAR(look_at(keyframes, i / 8.0).sky_colour[0], i, 1e-12);
        if (i == 7) continue;
        EXPECT_NEAR(look_at(keyframes, (i + 0.25) / 8.0).sky_colour[0], i + 0.25, 1e-12);
    }
}

/// The printed formula has no set behind the last one.
TEST(DayKeyframes, TheLastEighthGoesBackToTheFirstSet) {
    const config::Keyframes keyframes = numbered();
    EXPECT_NEAR(look_at(keyframes, 7.5 / 8.0).sky_colour[0], 3.5, 1e-12);
    EXPECT_NEAR(look_at(keyframes, 7.75 / 8.0).sky_colour[0], 1.75, 1e-12);
    EXPECT_NEAR(look_at(keyframes, std::nextafter(1.0, 0.0)).sky_colour[0], 0.0, 1e-12);
    EXPECT_NEAR(look_at(keyframes, 1.0).sky_colour[0], 0.0, 1e-12);
    EXPECT_NEAR(look_at(keyframes, -0.0625).sky_colour[0], 3.5, 1e-12);
    EXPECT_NEAR(look_at(keyframes, -1e-18).sky_colour[0], 0.0, 1e-9);
}

TEST(DayKeyframes, FogGoesAsExtinction) {
    const config::Keyframe look = look_at(numbered(), 0.5 / 8.0);
    EXPECT_NEAR(1.0 / visibility_of_fog_m(look), 0.5 * (1.0 / 1000.0 + 1.0 / 2000.0), 1e-15);
    config::Keyframe far;
    far.sky_fog_near_m = 1000.0;
    far.sky_fog_far_m = 3000.0;
    EXPECT_NEAR(visibility_of_fog_m(far), 2900.0, 1e-9);
}

TEST(DayKeyframes, GoodAndBadWeatherMix) {
    config::Keyframes keyframes = numbered();
    keyframes.good = 0.25;
    EXPECT_NEAR(look_at(keyframes, 0.3).sky_colour[1], 0.75, 1e-12);
}

TEST(DayKeyframes, TheDayFollowsTheMeanSun) {
    EXPECT_DOUBLE_EQ(solar_day(43'200.0, 0.0), 0.5);
    EXPECT_DOUBLE_EQ(solar_day(43'200.0, 180.0), 0.0);
    EXPECT_DOUBLE_EQ(solar_day(0.0, -90.0), 0.75);
}

TEST(DayKeyframes, ReachTheScene) {
    config::Config config = world::three_channels();
    config.start.longitude_deg = 0.0;  // at noon UTC: the set "day"
    config.sky.model = config::SkyModel::kWindlight;
    config.weather.driver = config::WeatherDriver::kKeyframes;
    config::Keyframe& day = config.weather.keyframes.good_day[4];
    day.sky_colour = {0.1, 0.2, 0.3};
    day.fog_colour = {0.5, 0.5, 0.5};
    day.sun_colour = {0.9, 0.8, 0.7};
    day.star_opacity = 0.5;
    day.sky_fog_near_m = 0.0;
    day.sky_fog_far_m = 10'000.0;
    day.cloud_cover = 1.5;
    config::WeatherLayer layer;
    layer.thickness_m = 500.0;
    layer.base_m = 1000.0;
    layer.coverage = 0.5;
    config.weather.layers = {layer};
    WeatherBench bench(config);
    const render::Scene& scene = bench.frame();
    EXPECT_NEAR(scene.sky.windlight.blue_horizon.z, 0.3, 1e-3);
    EXPECT_NEAR(scene.sky.windlight.haze_horizon, 0.5, 1e-3);
    EXPECT_NEAR(scene.sky.windlight.sunlight.x, 0.9, 1e-3);
    EXPECT_NEAR(scene.stars.intensity, 0.5, 1e-3);
    EXPECT_NEAR(scene.air.visibility_m, 9500.0, 10.0);
    EXPECT_NEAR(scene.weather.clouds[0].coverage, 0.75, 1e-3);
}

TEST(DayKeyframes, AreReadAndWhatHasNoPlaceIsRefused) {
    const auto load = [](const char* lines) {
        return config::parse_config(config::tests::with(lines), "site.toml");
    };
    const config::LoadResult good = load(
        "[weather]\ndriver = \"keyframes\"\n[weather.keyframes]\ngood = "
        "0.5\n[weather.keyframes.evening.bad]\n"
        "sky_colour = [0.1, 0.2, 0.3]\nsky_fog_near_m = 100\nsky_fog_far_m = 2000\n");
    ASSERT_TRUE(good);
    EXPECT_DOUBLE_EQ(good.config->weather.keyframes.bad_day[6].sky_colour[1], 0.2);
    EXPECT_DOUBLE_EQ(good.config->weather.keyframes.good, 0.5);
    const config::ConfigError refused = config::tests::error_of(
        config::tests::with("[weather.keyframes.night.good]\nmoon_colour = [1, 1, 1]\n"));
    EXPECT_EQ(refused.key, "weather.keyframes.night.good.moon_colour");
    EXPECT_NE(refused.message.find("has no place"), std::string::npos);
}

}  // namespace
}  // namespace skyig::server::weather
