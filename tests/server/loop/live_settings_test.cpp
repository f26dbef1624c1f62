// What of new settings is taken while frames go on, and what is only said.
#include "server/live_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "server/clock.h"

namespace skyig::server {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr std::string_view kSite = R"(version = 1
[host]
owns = ["control"]
stale_after_s = 0.5
[air]
visibility_m = 20000
[weather]
preset = "few"
[quality]
error_codes = 0.5
[log]
level = "info"
[[source]]
name = "station"
kind = "cigi"
listen = "127.0.0.1:8104"
[[channel]]
name = "left"
yaw_deg = -40
fov_deg = 60
width_px = 64
height_px = 48
)";

std::string with(std::string_view from, std::string_view to) {
    std::string text(kSite);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

config::KeyLog keys_of(const std::string& text) {
    config::KeyLog keys;
    const config::LoadResult loaded = config::parse_config(text, "site.toml", &keys);
    for (const config::ConfigError& error : loaded.errors)
        ADD_FAILURE() << to_text(error);
    return keys;
}

SettingsChange change_to(const std::string& text) {
    const config::KeyLog before = keys_of(std::string(kSite));
    return compare_settings(before, before, keys_of(text), "site.toml");
}

TEST(CompareSettings, OfTheSameFileFindsNothing) {
    const SettingsChange change = change_to(std::string(kSite));
    EXPECT_THAT(change.live, IsEmpty());
    EXPECT_THAT(change.at_start, IsEmpty());
}

TEST(CompareSettings, NamesEachKeyThatIsLive) {
    const std::vector<std::pair<std::string, std::string>> changes{
        {with("visibility_m = 20000", "visibility_m = 5000"), "air.visibility_m"},
        {with("[air]\n", "[air]\ntemperature_c = -5\n"), "air.temperature_c"},
        {with("visibility_m = 20000\n", ""), "air.visibility_m"},
        {with("\"few\"", "\"scattered\""), "weather.preset"},
        {with("error_codes = 0.5", "error_codes = 2.0"), "quality.error_codes"},
        {with("\"info\"", "\"error\""), "log.level"},
        {with("owns = [\"control\"]", "owns = [\"control\", \"time\"]"), "host.owns"},
        {with("stale_after_s = 0.5", "stale_after_s = 0.7"), "host.stale_after_s"},
        {with("[host]\n", "[host]\nlost_after_s = 9\n"), "host.lost_after_s"},
        {with("[host]\n", "[host]\npriority = 3\n"), "host.priority"},
        {with("name = \"station\"\n", "name = \"station\"\nowns = [\"weather\"]\n"), "source[1].owns"},
    };
    for (const auto& [text, key] : changes) {
        const SettingsChange change = change_to(text);
        EXPECT_THAT(change.live, ElementsAre(key)) << text;
        EXPECT_THAT(change.at_start, IsEmpty()) << key;
    }
}

TEST(CompareSettings, SaysWithItsLineWhatWaitsForTheNextStart) {
    EXPECT_THAT(change_to(with("yaw_deg = -40", "yaw_deg = -41")).at_start,
                ElementsAre("site.toml:19:11: channel[1].yaw_deg: is taken at the next start only"));
    EXPECT_THAT(change_to(with("127.0.0.1:8104", "127.0.0.1:8105")).at_start,
                ElementsAre(HasSubstr("source[1].listen: is taken at the next start only")));
    EXPECT_THAT(change_to(with("[host]\n", "[host]\nallow = [\"127.0.0.2\"]\n")).at_start,
                ElementsAre(HasSubstr("host.allow: is taken at the next start only")));
    EXPECT_THAT(change_to(with("preset = \"few\"\n", "preset = \"few\"\ntransition_s = 60\n")).at_start,
                ElementsAre(HasSubstr("weather.transition_s: is taken at the next start only")));
}

TEST(CompareSettings, OfATableThatIsNewOrGoneSaysOneLine) {
    const std::string more =
        std::string(kSite) +
        "[[channel]]\nname = \"right\"\nyaw_deg = 40\nfov_deg = 60\nwidth_px = 64\nheight_px = 48\n";
    EXPECT_THAT(change_to(more).at_start,
                ElementsAre("site.toml: channel[2]: is taken at the next start only"));
    const config::KeyLog both = keys_of(more);
    const SettingsChange gone = compare_settings(both, both, keys_of(std::string(kSite)), "site.toml");
    EXPECT_THAT(gone.at_start,
                ElementsAre("site.toml: channel[2]: its absence is taken at the next start only"));
    EXPECT_THAT(gone.live, IsEmpty());
}

TEST(CompareSettings, TellsLiveKeysFromWhatWasTakenLastAndTheRestFromTheStart) {
    const config::KeyLog start = keys_of(std::string(kSite));
    const std::string second_text = with("visibility_m = 20000", "visibility_m = 5000");
    const config::KeyLog second = keys_of(second_text);
    // Back again: live since it holds otherwise; and nothing is other than at the start.
    const SettingsChange back = compare_settings(start, second, start, "site.toml");
    EXPECT_THAT(back.live, ElementsAre("air.visibility_m"));
    EXPECT_THAT(back.at_start, IsEmpty());
}

/// Settings in a file of their own.
class LiveSettingsTest : public ::testing::Test {
  protected:
    LiveSettingsTest() {
        write(std::string(kSite));
        config::KeyLog keys;
        config::LoadResult loaded = config::load_config(path_, &keys);
        settings_ = std::make_unique<LiveSettings>(path_, *loaded.config, keys);
    }
    ~LiveSettingsTest() override { std::filesystem::remove(path_); }

    void write(const std::string& text) const { std::ofstream(path_) << text; }

    /// Reads anew, waits for it, and takes.
    LiveSettings::Result read() {
        settings_->read_anew();
        for (;;) {
            const auto result = settings_->take([this](const config::Config&) { ++taken_; }, log_);
            if (result != LiveSettings::Result::kNone) return result;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    std::string path_ = ::testing::TempDir() + "live_settings_test.toml";
    ManualClock clock_;
    std::vector<std::string> said_;
    Log log_{clock_, [this](Severity, std::string_view line) { said_.emplace_back(line); }};
    std::unique_ptr<LiveSettings> settings_;
    int taken_ = 0;
};

TEST_F(LiveSettingsTest, TakeWhatIsLiveAndKeepTheRestOfTheStart) {
    std::string text = with("visibility_m = 20000", "visibility_m = 5000");
    text.replace(text.find("yaw_deg = -40"), 13, "yaw_deg = -41");
    text.replace(text.find("name = \"station\"\n"), 17, "name = \"station\"\npriority = 7\n");
    write(text);
    EXPECT_EQ(read(), LiveSettings::Result::kTaken);
    EXPECT_EQ(taken_, 1);
    EXPECT_EQ(settings_->config().air.visibility_m, 5000.0);
    EXPECT_EQ(settings_->config().sources.front().rights.priority, 7);
    EXPECT_EQ(settings_->config().channels.front().yaw_deg, -40.0);
    EXPECT_THAT(said_,
                UnorderedElementsAre(HasSubstr("settings read anew: source[1].priority, air.visibility_m"),
                                     HasSubstr("channel[1].yaw_deg: is taken at the next start only")));
}

TEST_F(LiveSettingsTest, OfABrokenFileHoldOnToWhatHeld) {
    write(with("visibility_m = 20000", "visibility_m = 3"));
    EXPECT_EQ(read(), LiveSettings::Result::kRefused);
    EXPECT_EQ(taken_, 0);
    EXPECT_EQ(settings_->config().air.visibility_m, 20000.0);
    ASSERT_EQ(said_.size(), 1U);
    EXPECT_THAT(said_.front(), HasSubstr("air.visibility_m: is 3"));
    write(with("visibility_m = 20000", "visibility_m = 4000"));
    EXPECT_EQ(read(), LiveSettings::Result::kTaken);
    EXPECT_EQ(settings_->config().air.visibility_m, 4000.0);
}

TEST_F(LiveSettingsTest, OfAFileThatIsGoneHoldOnToWhatHeld) {
    std::filesystem::remove(path_);
    EXPECT_EQ(read(), LiveSettings::Result::kRefused);
    EXPECT_EQ(settings_->config().air.visibility_m, 20000.0);
    EXPECT_THAT(said_.front(), HasSubstr(path_));
}

}  // namespace
}  // namespace skyig::server
