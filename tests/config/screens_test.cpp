// [display], the displays of channels, and [quality].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.h"
#include "tests/config/texts.h"

namespace skyig::config {
namespace {

using testing::HasSubstr;
using tests::error_of;
using tests::errors_of;
using tests::with;

TEST(Screens, AdaptationFollowsTheDisplayUnlessGiven) {
    const LoadResult result = parse_config(with("[display]\nmax_luminance_cd_m2 = 80"), "site.toml");
    ASSERT_TRUE(result);
    EXPECT_EQ(result.config->display.adaptation_cd_m2, 40.0);
    EXPECT_FALSE(result.config->channels[0].display);
}

TEST(Screens, ChannelsScreenIsAVariantOfTheUsualOne) {
    const auto screen_of = [](const std::string& keys) {
        const LoadResult result =
            parse_config(with("[display]\nmax_luminance_cd_m2 = 80\ngamma = 2.4\nblack_cd_m2 = 0.5") +
                             "\n[channel.display]\n" + keys,
                         "site.toml");
        EXPECT_TRUE(result) << to_text(result.errors.front());
        return result ? result.config->channels[0].display : std::nullopt;
    };
    EXPECT_EQ(screen_of(""), (Screen{80.0, 40.0, 2.4, 0.5, 0.0}));
    EXPECT_EQ(screen_of("max_luminance_cd_m2 = 300"), (Screen{300.0, 150.0, 2.4, 0.5, 0.0}));
    EXPECT_EQ(screen_of("gamma = \"srgb\"\nreflected_cd_m2 = 2"),
              (Screen{80.0, 40.0, std::nullopt, 0.5, 2.0}));
    const LoadResult wrong = parse_config(with("") + "\n[channel.display]\ndither = true", "site.toml");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.errors.front().key, "channel[1].display.dither");
}

TEST(Screens, AScreenThatCanShowNothingAboveItsBlackIsRefused) {
    const ConfigError error = error_of(with("[display]\nmax_luminance_cd_m2 = 100\nreflected_cd_m2 = 120"));
    EXPECT_EQ(error.key, "display.reflected_cd_m2");
    EXPECT_EQ(error.line, 4);
    EXPECT_THAT(error.message, HasSubstr("full white, 100 cd/m2, must be more"));
    EXPECT_EQ(error_of(with("[display]\nblack_cd_m2 = 400")).key, "display.black_cd_m2");
    EXPECT_TRUE(errors_of(with("[display]\nmax_luminance_cd_m2 = 100\nreflected_cd_m2 = 99")).empty());
}

TEST(Screens, ChannelsShowAPatternByName) {
    const auto pattern_of = [](const std::string& key) {
        const LoadResult result = parse_config(with("") + key, "site.toml");
        EXPECT_TRUE(result);
        return result ? result.config->channels[0].pattern : Pattern::kOff;
    };
    EXPECT_EQ(pattern_of(""), Pattern::kOff);
    for (std::size_t i = 0; i < kPatternNames.size(); ++i)
        EXPECT_EQ(pattern_of("pattern = \"" + std::string(kPatternNames[i]) + "\""), static_cast<Pattern>(i));
    const ConfigError error = error_of(with("") + "pattern = \"cheker\"");
    EXPECT_EQ(error.key, "channel[1].pattern");
    EXPECT_THAT(error.message, HasSubstr("checker"));
    Config config = default_config();
    show_pattern(config, "grid");
    EXPECT_EQ(config.channels[0].pattern, Pattern::kGrid);
    show_pattern(config, "nonsense");
    EXPECT_EQ(config.channels[0].pattern, Pattern::kGrid);
}

TEST(Screens, AChannelMayLookThroughAWindscreen) {
    EXPECT_EQ(parse_config(with(""), "site.toml").config->channels[0].windscreen_m, 0.0);
    const LoadResult result = parse_config(with("") + "windscreen_m = 0.8", "site.toml");
    ASSERT_TRUE(result);
    EXPECT_EQ(result.config->channels[0].windscreen_m, 0.8);
    const ConfigError error = error_of(with("") + "windscreen_m = 0.1");
    EXPECT_EQ(error.key, "channel[1].windscreen_m");
    EXPECT_THAT(error.message, HasSubstr("0.3"));
}

TEST(Screens, ChannelsOverlayIsAVariantOfTheUsualOne) {
    const LoadResult result = parse_config(
        with("[overlay]\nmode = true\nhost_lost = true") + "[channel.overlay]\nmode = false\nscale = 4",
        "site.toml");
    ASSERT_TRUE(result);
    EXPECT_EQ(result.config->overlay, (Overlay{.mode = true, .host_lost = true}));
    EXPECT_EQ(result.config->channels[0].overlay, (Overlay{.host_lost = true, .scale = 4}));
    EXPECT_EQ(parse_config(with(""), "site.toml").config->overlay, Overlay{});
    EXPECT_THAT(error_of(with("[overlay]\nscale = 9")).message, HasSubstr("1..8"));
    EXPECT_EQ(error_of(with("[overlay]\nclock = true")).key, "overlay.clock");
}

TEST(Quality, IsGivenInCodesOrInPercent) {
    const LoadResult result = parse_config(with("[quality]\nerror_pct = 3.4"), "site.toml");
    ASSERT_TRUE(result);
    EXPECT_EQ(result.config->quality.error_pct, 3.4);
    EXPECT_EQ(result.config->quality.error_codes, 0.5);
    EXPECT_THAT(error_of(with("[quality]\nerror_pct = 3\nerror_codes = 1")).message,
                HasSubstr("stands beside error_codes; give one of them"));
    EXPECT_THAT(error_of(with("[quality]\nerror_codes = 9")).message, HasSubstr("0.1..8"));
}

}  // namespace
}  // namespace skyig::config
