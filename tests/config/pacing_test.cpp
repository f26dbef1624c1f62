// [daemon] and [overload].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.h"
#include "tests/config/texts.h"

namespace skyig::config {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::error_of;
using tests::with;

Config config_of(const std::string& text) {
    const LoadResult result = parse_config(text, "site.toml");
    EXPECT_TRUE(result) << text << (result.errors.empty() ? "" : to_text(result.errors.front()));
    return result ? *result.config : default_config();
}

TEST(Pacing, IsByTheClockAndLooksAFrameAndAHalfAheadByDefault) {
    const Config config = config_of(with("[daemon]\nrate_hz = 50"));
    EXPECT_EQ(config.daemon.pacing, Pacing::kClock);
    EXPECT_NEAR(config.daemon.display_delay_s(), 0.03, 1e-12);
    EXPECT_NEAR(config_of(with("[daemon]\ndisplay_delay_ms = 12")).daemon.display_delay_s(), 0.012, 1e-12);
    EXPECT_TRUE(config.overload.order.empty());
}

TEST(Pacing, WaitsForTheHostAsLongAsTheSettingsSay) {
    const Config config =
        config_of(with("[daemon]\nrate_hz = 50\npace = \"host\"\nhost_wait_ms = 30\nhost_frames_behind = 1"));
    EXPECT_EQ(config.daemon.pacing, Pacing::kHost);
    EXPECT_NEAR(config.daemon.host_wait_s(), 0.03, 1e-12);
    EXPECT_EQ(config.daemon.host_frames_behind, 1);
    EXPECT_NEAR(config_of(with("[daemon]\nrate_hz = 50\npace = \"host\"")).daemon.host_wait_s(), 0.02, 1e-12);
}

TEST(Pacing, WhatDoesNotGoTogetherIsRefused) {
    EXPECT_THAT(error_of(with("[daemon]\nhost_wait_ms = 30")).message, HasSubstr("unless pace is \"host\""));
    const ConfigError display = error_of(with("[daemon]\npace = \"display\""));
    EXPECT_EQ(display.key, "daemon.pace");
    EXPECT_EQ(display.line, 3);
    EXPECT_THAT(display.message, HasSubstr("kind = \"window\""));
    EXPECT_THAT(
        error_of(with("[output]\nkind = \"window\"\nvsync = false\n[daemon]\npace = \"display\"")).key,
        "daemon.pace");
    EXPECT_EQ(config_of(with("[output]\nkind = \"window\"\n[daemon]\npace = \"display\"")).daemon.pacing,
              Pacing::kDisplay);
    EXPECT_THAT(error_of(with("[daemon]\npace = \"host\"\n[host]\nenabled = false")).message,
                HasSubstr("enabled = false in [host]"));
    EXPECT_THAT(error_of(with("[daemon]\npace = \"free\"")).message, HasSubstr("\"clock\""));
}

TEST(Overload, TakesAnOrderOfWhatMayBeLeftOut) {
    const Overload overload = config_of(with("[overload]\norder = [\"glare\", \"cloud-refresh\"]\n"
                                             "thin_above_pct = 95\nreturn_after_frames = 60"))
                                  .overload;
    EXPECT_THAT(overload.order, ElementsAre(Thinning::kGlare, Thinning::kCloudRefresh));
    EXPECT_EQ(overload.thin_above_pct, 95.0);
    EXPECT_EQ(overload.return_after_frames, 60);
}

TEST(Overload, AnOrderOfOtherThingsIsRefused) {
    EXPECT_THAT(error_of(with("[overload]\norder = [\"fog\"]")).message, HasSubstr("\"cloud-refresh\""));
    EXPECT_THAT(error_of(with("[overload]\norder = [\"dome\"]")).message,
                AllOf(HasSubstr("\"dome\", which is no more: leaving it out saved no time"),
                      HasSubstr("\"cloud-tones\"")));
    EXPECT_THAT(error_of(with("[overload]\norder = [3]")).message, HasSubstr("holds a whole number"));
    EXPECT_THAT(error_of(with("[overload]\norder = \"glare\"")).message, HasSubstr("a list"));
    EXPECT_THAT(error_of(with("[overload]\norder = [\"glare\", \"glare\"]")).message, HasSubstr("twice"));
    EXPECT_THAT(error_of(with("[overload]\nreturn_below_pct = 90")).message, HasSubstr("come and go"));
    EXPECT_THAT(error_of(with("[overload]\nthin_above_pct = 60")).key, "overload.thin_above_pct");
}

}  // namespace
}  // namespace skyig::config
