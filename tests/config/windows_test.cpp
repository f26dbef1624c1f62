// [[window]], [channel.viewport] and what stands in for them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.h"
#include "tests/config/texts.h"

namespace skyig::config {
namespace {

using testing::HasSubstr;
using tests::error_of;
using tests::kChannel;
using tests::with;

Config config_of(const std::string& text) {
    const LoadResult result = parse_config(text, "site.toml");
    EXPECT_TRUE(result) << text << (result.errors.empty() ? "" : to_text(result.errors.front()));
    return result ? *result.config : default_config();
}

TEST(Windows, WithoutAnyEachChannelHasOneBesideTheLast) {
    const Config config =
        config_of(with("[output]\nkind = \"window\"") +
                  "[[channel]]\nname = \"right\"\nwidth_px = 640\nheight_px = 480\nfov_deg = 60\n");
    ASSERT_EQ(config.windows.size(), 2U);
    EXPECT_TRUE(config.output.vsync);
    EXPECT_EQ(config.windows[1].name, "right");
    EXPECT_EQ(config.windows[1].x_px, 1280);
    EXPECT_EQ(config.windows[1].width_px, 640);
    ASSERT_TRUE(config.channels[1].viewport);
    EXPECT_EQ(config.channels[1].viewport->window, 1);
    EXPECT_THAT(describe(config), HasSubstr("in windows"));
    EXPECT_TRUE(config_of(with("")).windows.empty());
}

TEST(Windows, ChannelsLieInTheWindowThatTheyName) {
    const Config config = config_of(
        with("[[window]]\nname = \"a\"\nmonitor = \"HDMI-1\"\n[[window]]\nname = \"b\"\nx_px = -1280\nframe "
             "= false") +
        "[channel.viewport]\nwindow = \"b\"\n"
        "[[channel]]\nname = \"right\"\nwidth_px = 640\nheight_px = 480\nfov_deg = 60\n"
        "[channel.viewport]\nwindow = \"a\"\nx_px = 1920\ny_px = 8\nwidth_px = 960\nheight_px = 720\n");
    ASSERT_EQ(config.windows.size(), 2U);
    EXPECT_EQ(config.windows[0].monitor, "HDMI-1");
    EXPECT_EQ(config.windows[1].x_px, -1280);
    EXPECT_FALSE(config.windows[1].frame);
    EXPECT_EQ(config.channels[0].viewport->window, 1);
    EXPECT_EQ(config.channels[1].viewport->window, 0);
    EXPECT_EQ(config.channels[1].viewport->x_px, 1920);
    EXPECT_EQ(config.channels[1].viewport->height_px, 720);
}

TEST(Windows, WhatCannotBeShownIsRefusedWithTheReason) {
    EXPECT_THAT(error_of(with("") + "[channel.viewport]\nwindow = \"a\"\n").message,
                HasSubstr("add a [[window]]"));
    const std::string window = "[[window]]\nname = \"main\"\nwidth_px = 1000\n";
    EXPECT_THAT(error_of(with(window) + "[channel.viewport]\nwindow = \"mian\"\n").message,
                HasSubstr("did you mean \"main\"?"));
    EXPECT_THAT(error_of(with(window) + "[channel.viewport]\nwindow = \"main\"\n").message,
                HasSubstr("reaches to 1280 x 1024 pixels; window \"main\" has 1000 x 1024"));
    EXPECT_EQ(error_of(with(window)).key, "channel[1].viewport");
    EXPECT_EQ(error_of(with("[[window]]\nname = \"a\"\nmonitor = \"0\"\nx_px = 4") +
                       "[channel.viewport]\nwindow = \"a\"\n")
                  .key,
              "window[1].x_px");
    EXPECT_EQ(error_of(with("[[window]]\nname = \"a\"\n[[window]]\nname = \"a\"") +
                       "[channel.viewport]\nwindow = \"a\"\n")
                  .key,
              "window[2].name");
    EXPECT_THAT(error_of(with("[window]\nname = \"a\"")).message, HasSubstr("double brackets"));
    EXPECT_EQ(error_of(with("[[window]]\nframe = true") + "[channel.viewport]\nwindow = \"\"\n").key,
              "window[1].name");
}

}  // namespace
}  // namespace skyig::config
