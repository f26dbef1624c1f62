// The reference of keys and the effective settings against the reader that they come from.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "config/key_log.h"
#include "config/reference/effective.h"
#include "config/reference/meanings.h"
#include "config/reference/pages.h"
#include "tests/config/texts.h"

namespace skyig::config::reference {
namespace {

using ::testing::HasSubstr;

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Reference, EveryKeyHasAMeaningAndEveryMeaningAKey) {
    const std::vector<KeyRow> keys = every_key();
    for (const KeyRow& row : keys)
        EXPECT_FALSE(row.meaning.empty())
            << "no meaning in config/reference: " << row.table << '.' << row.key;
    std::size_t meanings = 0;
    for (const auto& some : {meanings_of_site(), meanings_of_world()}) {
        meanings += some.size();
        for (const Meaning& meaning : some) {
            EXPECT_TRUE(std::any_of(keys.begin(), keys.end(),
                                    [&meaning](const KeyRow& row) {
                                        return row.table == meaning.table && row.key == meaning.key;
                                    }))
                << "nobody reads " << meaning.table << '.' << meaning.key;
        }
    }
    std::printf("%zu keys, %zu meanings\n", keys.size(), meanings);
}

// A page that differs is written as it should be into the directory of the build.
TEST(Reference, PagesShowWhatTheReaderReads) {
    std::map<std::string, int> shown;
    for (const std::string& name : std::vector<std::string>{"configuration.md", "weather.md"}) {
        const std::string page = text_of(SKYIG_SOURCE_DIR "/docs/" + name);
        ASSERT_FALSE(page.empty());
        for (const std::string& table : tables_shown(page))
            ++shown[table];
        const std::string right = with_key_tables(page);
        if (right == page) continue;
        const std::string made = (std::filesystem::temp_directory_path() / ("skyig-" + name)).string();
        std::ofstream(made) << right;
        ADD_FAILURE() << "docs/" << name << " is not what the reader reads; as it should be: cp " << made
                      << " docs/" << name;
    }
    for (const KeyRow& row : every_key()) {
        const bool told_in_words =
            row.table.empty() || row.table == "channel.display" || row.table == "channel.overlay";
        EXPECT_EQ(shown[row.table], told_in_words ? 0 : 1) << "tables of [" << row.table << "] in docs";
    }
}

/// The comments that hold a value made settings.
std::string with_defaults_given(const std::string& text) {
    std::string given;
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view line = rest.substr(0, end);
        if (line.starts_with("# ") && line.find(" = ") != std::string_view::npos) line.remove_prefix(2);
        given += fmt::format("{}\n", line);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return given;
}

void expect_same(const KeyLog& wanted, const std::string& text) {
    KeyLog read;
    const LoadResult result = parse_config(text, SKYIG_SOURCE_DIR "/config/examples/effective.toml", &read);
    for (const ConfigError& error : result.errors)
        ADD_FAILURE() << to_text(error);
    ASSERT_EQ(read.uses().size(), wanted.uses().size());
    for (std::size_t i = 0; i < wanted.uses().size(); ++i) {
        const KeyUse &use = wanted.uses()[i], &again = read.uses()[i];
        EXPECT_EQ(again.key, use.key);
        EXPECT_EQ(again.value, use.value) << use.table << '.' << use.key;
    }
}

constexpr std::string_view kRich = R"(
[daemon]
pace = "host"
host_frames_behind = 1
[overload]
order = ["milky-way", "glare"]
[host]
allow = ["192.0.2.1:99", "127.0.0.1"]
owns = ["control", "ownship"]
[[source]]
name = "bus"
kind = "canaerospace"
interface = "can0"
identifiers = { "12" = 40, heading = 41 }
[start]
utc = 2026-06-21T04:05:06.25Z
[display]
gamma = 2.2
[weather]
preset = "storm"
[[weather.layer]]
type = "cirrus"
base_ft = 20000
thickness_ft = 500
[[weather.sheet]]
type = "cirrus"
[[weather.sheet.texture]]
noise = "fibres"
weight = 0.5
[[weather.area]]
latitude_deg = 47
longitude_deg = 8
half_length_m = 4000
[[weather.area.layer]]
type = "fog"
top_m = 40
visibility_m = 100
[[weather.area.layer]]
type = "rain"
top_m = 2000
[[night.city]]
latitude_deg = 47.4
longitude_deg = 8.5
population = 4e5
[[window]]
name = "all"
[[window]]
name = "projector"
monitor = "HDMI-1"
)";

TEST(EffectiveSettings, ReadBackAsTheSameWithDefaultsLeftOutAndGiven) {
    std::vector<std::string> texts;
    for (const char* name :
         {"one-channel.toml", "three-channels.toml", "two-machines.toml", "instructor.toml"})
        texts.push_back(text_of(SKYIG_SOURCE_DIR "/config/examples/" + std::string(name)));
    texts.push_back(tests::with(kRich) + "[channel.viewport]\nwindow = \"all\"\n");
    for (const std::string& text : texts) {
        KeyLog keys;
        const LoadResult result =
            parse_config(text, SKYIG_SOURCE_DIR "/config/examples/effective.toml", &keys);
        for (const ConfigError& error : result.errors)
            ADD_FAILURE() << to_text(error);
        const std::string effective = effective_text(keys);
        expect_same(keys, effective);
        expect_same(keys, with_defaults_given(effective));
    }
}

TEST(EffectiveSettings, TellWhatIsGivenAsSettingsAndTheRestAsComments) {
    KeyLog keys;
    ASSERT_TRUE(parse_config(tests::with("[air]\nvisibility_m = 5e3\n"), "site.toml", &keys));
    const std::string text = effective_text(keys);
    EXPECT_THAT(text, HasSubstr("\n[air]\nvisibility_m = 5000\n# visibility_contrast = 0.05\n"));
    EXPECT_THAT(text, HasSubstr("\n[quality]\n# error_codes = 0.5\n# error_pct: not given\n"));
    EXPECT_THAT(text, HasSubstr("\n[[channel]]\nname = \"centre\"\n"));
}

}  // namespace
}  // namespace skyig::config::reference
