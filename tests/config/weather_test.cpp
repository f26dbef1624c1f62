// [weather]: its keys, what is refused and how that is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.h"
#include "tests/config/texts.h"

namespace skyig::config {
namespace {

using testing::HasSubstr;
using tests::error_of;
using tests::with;

Config good(std::string_view lines) {
    LoadResult result = parse_config(with(lines), "site.toml");
    for (const ConfigError& error : result.errors)
        ADD_FAILURE() << to_text(error);
    return result.config.value_or(default_config());
}

constexpr std::string_view kLayer = "[[weather.layer]]\ntype = \"cumulus\"\nbase_m = 1000\ntop_m = 1500\n";

std::string layer_with(std::string_view key) {
    return with(fmt::format("{}{}\n", kLayer, key));
}

TEST(Weather, ALayerIsReadInEitherUnit) {
    const Config config = good(
        "[weather]\nelevation_m = 430\ntransition_s = 5\nclouds = \"volume\"\n"
        "[[weather.layer]]\ntype = \"stratus\"\nbase_ft = 1000\nthickness_ft = 500\ncoverage_oktas = 8\n"
        "bottom_band_m = 10\nvisibility_m = 60\nscud_pct = 20\n"
        "[[weather.layer]]\ntype = \"rain\"\ntop_m = 300\nrate_mm_h = 4\nwind_m_s = 5\nwind_from_deg = "
        "270\n");
    const Weather& weather = config.weather;
    ASSERT_EQ(weather.layers.size(), 2U);
    const WeatherLayer& stratus = weather.layers[0];
    EXPECT_EQ(stratus.type, LayerType::kStratus);
    EXPECT_DOUBLE_EQ(stratus.base_m, 304.8);
    EXPECT_DOUBLE_EQ(stratus.thickness_m, 152.4);
    EXPECT_DOUBLE_EQ(stratus.coverage, 1.0);
    EXPECT_DOUBLE_EQ(stratus.bottom_band_m, 10.0);
    EXPECT_DOUBLE_EQ(stratus.top_band_m, 30.0);
    EXPECT_DOUBLE_EQ(stratus.bottom_scud_pct, 20.0);
    EXPECT_DOUBLE_EQ(weather.layers[1].base_m + weather.layers[1].thickness_m, 300.0);
    EXPECT_DOUBLE_EQ(weather.layers[1].wind_m_s.value_or(0.0), 5.0);
    EXPECT_EQ(weather.clouds, CloudModel::kVolume);
    EXPECT_DOUBLE_EQ(weather.transition_s, 5.0);
}

TEST(Weather, WhatIsWrongIsToldWithItsKey) {
    EXPECT_THAT(error_of(with("[[weather.layer]]\ntype = \"cumullus\"\nbase_m = 1\ntop_m = 9\n")).message,
                HasSubstr("did you mean \"cumulus\"?"));
    EXPECT_EQ(error_of(layer_with("base_ft = 3000")).key, "weather.layer[1].base_ft");
    EXPECT_EQ(error_of(layer_with("thickness_m = 20")).key, "weather.layer[1].top_m");
    EXPECT_EQ(error_of(layer_with("rate_mm_h = 2")).key, "weather.layer[1].rate_mm_h");
    EXPECT_EQ(error_of(layer_with("wind_from_deg = 20")).key, "weather.layer[1].wind_from_deg");
    EXPECT_EQ(error_of(layer_with("id = 5")).key, "weather.layer[1].id");
    EXPECT_THAT(error_of(layer_with("bse_m = 2")).message, HasSubstr("unknown key"));
    EXPECT_THAT(error_of(with("[[weather.layer]]\ntype = \"cumulus\"\nbase_m = 900\ntop_m = 800\n")).message,
                HasSubstr("not above the base"));
    EXPECT_EQ(error_of(with("[[weather.layer]]\ntype = \"fog\"\ntop_m = 80\n")).key,
              "weather.layer[1].visibility_m");
    EXPECT_THAT(error_of(with("[weather]\nmetar = \"\"\n")).message, HasSubstr("is empty"));
    EXPECT_THAT(error_of(with("[weather]\npreset = \"few\"\nmetar = \"METAR X\"\n")).message,
                HasSubstr("stands beside preset"));
    EXPECT_THAT(error_of(with("[weather]\ndriver = \"keyframe\"\n")).message, HasSubstr("did you mean"));
    EXPECT_THAT(error_of(with("[weather]\npreset = \"storms\"\n")).message,
                HasSubstr("did you mean \"storm\"?"));
}

constexpr std::string_view kArea =
    "[[weather.area]]\nlatitude_deg = 47.5\nlongitude_deg = 8.5\nhalf_length_m = 20000\n";

std::string area_with(std::string_view lines) {
    return with(fmt::format("{}{}\n", kArea, lines));
}

constexpr std::string_view kAreaLayer =
    "[[weather.area.layer]]\ntype = \"rain\"\ntop_m = 900\nrate_mm_h = 4\n";

TEST(Weather, AnAreaHoldsLayersOfItsOwn) {
    const Config config = good(
        fmt::format("{}{}half_width_m = 9000\ncorner_radius_m = 9000\nrotation_deg = 30\nperimeter_m = 4000\n"
                    "merge = true\nid = 7\n{}{}{}",
                    kLayer, kArea, kAreaLayer, kArea, kAreaLayer));
    ASSERT_EQ(config.weather.layers.size(), 1U);
    ASSERT_EQ(config.weather.areas.size(), 2U);
    const WeatherArea& first = config.weather.areas[0];
    EXPECT_EQ(first.id.value_or(0), 7);
    EXPECT_DOUBLE_EQ(first.latitude_deg, 47.5);
    EXPECT_DOUBLE_EQ(first.longitude_deg, 8.5);
    EXPECT_DOUBLE_EQ(first.half_length_m, 20e3);
    EXPECT_DOUBLE_EQ(first.half_width_m, 9e3);
    EXPECT_DOUBLE_EQ(first.corner_radius_m, 9e3);
    EXPECT_DOUBLE_EQ(first.rotation_deg, 30.0);
    EXPECT_DOUBLE_EQ(first.perimeter_m, 4e3);
    EXPECT_TRUE(first.merge);
    ASSERT_EQ(first.layers.size(), 1U);
    EXPECT_EQ(first.layers[0].type, LayerType::kRain);
    const WeatherArea& second = config.weather.areas[1];
    EXPECT_DOUBLE_EQ(second.half_width_m, 20e3) << "a square where no width is told";
    EXPECT_FALSE(second.id);
    EXPECT_THAT(describe(config), HasSubstr(", weather of 1 layer and 2 areas"));
}

TEST(Weather, WhatIsWrongInAnAreaIsToldWithItsKey) {
    EXPECT_EQ(error_of(area_with("")).key, "weather.area[1].layer");
    EXPECT_EQ(error_of(area_with("[[weather.area.layer]]\ntype = \"rain\"\n")).key,
              "weather.area[1].layer[1].top_m");
    EXPECT_EQ(error_of(area_with(fmt::format("corner_radius_m = 21000\n{}", kAreaLayer))).key,
              "weather.area[1].corner_radius_m");
    EXPECT_THAT(error_of(area_with(fmt::format("half_widht_m = 9\n{}", kAreaLayer))).message,
                HasSubstr("half_width_m"));
    EXPECT_EQ(error_of(with("[[weather.area]]\nlatitude_deg = 1\nlongitude_deg = 2\n[[weather.area.layer]]\n"
                            "type = \"rain\"\ntop_m = 900\n"))
                  .key,
              "weather.area[1].half_length_m");
    const std::string one = fmt::format("{}id = 3\n{}", kArea, kAreaLayer);
    EXPECT_EQ(error_of(with(one + one)).key, "weather.area[2].id");
    std::string many;
    for (int i = 0; i < 33; ++i)
        many += fmt::format("{}{}", kArea, kAreaLayer);
    EXPECT_THAT(error_of(with(many)).message, HasSubstr("makes 33; at most 32"));
}

TEST(Weather, TheFilesOwnTablesComeOverThePresets) {
    const Config config =
        good(fmt::format("[weather]\npreset = \"scattered\"\n{}[air]\nvisibility_m = 22000\n", kLayer));
    EXPECT_DOUBLE_EQ(config.air.visibility_m, 22'000.0);
    ASSERT_EQ(config.weather.layers.size(), 2U);
    EXPECT_DOUBLE_EQ(good("[weather]\npreset = \"scattered\"\n").air.visibility_m, 15'000.0);
    EXPECT_THAT(describe(config), HasSubstr(", weather scattered of 2 layers"));
}

}  // namespace
}  // namespace skyig::config
