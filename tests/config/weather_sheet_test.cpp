// [[weather.sheet]]: what its textures may be, and how it is told that one is not.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "config/config.h"
#include "config/warp/grey_map.h"
#include "tests/config/warp_files.h"

namespace skyig::config {
namespace {

using testing::HasSubstr;
using tests::Folder;

std::string settings_with(std::string_view texture) {
    return fmt::format(
        "version = 1\n[[channel]]\nname = \"centre\"\n[weather]\n[[weather.sheet]]\ntype = \"cirrus\"\n"
        "[[weather.sheet.texture]]\n{}\n",
        texture);
}

LoadResult read_in(const Folder& folder, std::string_view texture) {
    return parse_config(settings_with(texture), folder.path("site.toml"));
}

std::string image(int width, int height, const std::function<double(double x, double y)>& at) {
    return tests::png(width, height, 1, [&](int x, int y, int) {
        return static_cast<std::uint8_t>(
            std::lround(255.0 * at(static_cast<double>(x) / width, static_cast<double>(y) / height)));
    });
}

double waves(double x, double y) {
    return 0.5 + 0.4 * std::sin(2.0 * std::numbers::pi * (2.0 * x + y));
}

TEST(WeatherSheet, ATexturesImageIsReadFromBesideTheSettings) {
    const Folder folder;
    folder.write("streaks.png", image(64, 64, waves));
    const LoadResult read =
        read_in(folder, "image = \"streaks.png\"\nsize_m = 20000\nscroll_m_s = 5\nweight = 0.8");
    for (const ConfigError& error : read.errors)
        ADD_FAILURE() << to_text(error);
    ASSERT_TRUE(read.config);
    ASSERT_EQ(read.config->weather.sheets.size(), 1U);
    const WeatherSheet& sheet = read.config->weather.sheets[0];
    EXPECT_EQ(sheet.type, LayerType::kCirrus);
    ASSERT_EQ(sheet.textures.size(), 1U);
    const WeatherTexture& texture = sheet.textures[0];
    ASSERT_TRUE(texture.image);
    // The lowest row comes first.
    EXPECT_NEAR(static_cast<double>(texture.image->values[5]), waves(5.0 / 64, 63.0 / 64), 0.5 / 255);
    EXPECT_DOUBLE_EQ(texture.size_m, 20000.0);
    EXPECT_DOUBLE_EQ(texture.weight, 0.8);
}

TEST(WeatherSheet, AnImageThatCannotServeIsToldWithItsKeyAndReason) {
    const Folder folder;
    folder.write("wide.png", image(64, 32, waves));
    folder.write("odd.png", image(48, 48, waves));
    folder.write("tiny.png", image(8, 8, waves));
    folder.write("seam.png", image(64, 64, [](double x, double) { return x; }));
    folder.write("ledge.png", image(64, 64, [](double, double y) { return y; }));
    folder.write("text.png", "no picture at all");
    struct Case {
        std::string_view file, reason;
    };
    for (const Case& each :
         {Case{"wide.png", "64x32 pixels; it must be square, 16, 32, 64"}, Case{"odd.png", "48x48 pixels"},
          Case{"tiny.png", "8x8 pixels"}, Case{"seam.png", "left and right edges differ by 251 of 255"},
          Case{"ledge.png", "upper and lower edges differ by 251 of 255"},
          Case{"text.png", "cannot be read as PNG"}, Case{"gone.png", "gone.png"}}) {
        const LoadResult read = read_in(folder, fmt::format("image = \"{}\"", each.file));
        ASSERT_EQ(read.errors.size(), 1U) << each.file;
        EXPECT_EQ(read.errors[0].key, "weather.sheet[1].texture[1].image");
        EXPECT_EQ(read.errors[0].line, 8);
        EXPECT_THAT(read.errors[0].message, HasSubstr(each.reason));
    }
}

TEST(WeatherSheet, WhatIsWrongOtherwiseIsToldToo) {
    const Folder folder;
    folder.write("streaks.png", image(64, 64, waves));
    const auto key_of = [&](std::string_view texture) {
        const LoadResult read = read_in(folder, texture);
        return read.errors.empty() ? std::string("none") : read.errors[0].key;
    };
    EXPECT_EQ(key_of("image = \"streaks.png\"\nnoise = \"puffs\""), "weather.sheet[1].texture[1].noise");
    EXPECT_EQ(key_of("size_m = 10"), "weather.sheet[1].texture[1].size_m");
    EXPECT_EQ(key_of("noise = \"fibres\"\n[[weather.sheet]]\ntype = \"fog\"\n[[weather.sheet.texture]]"),
              "weather.sheet[2].type");
    EXPECT_EQ(key_of("\n[[weather.sheet]]\ntype = \"stratus\""), "weather.sheet[2].texture");
    EXPECT_EQ(key_of("noise = \"fibres\""), "none");
}

}  // namespace
}  // namespace skyig::config
