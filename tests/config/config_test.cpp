#include "config/config.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "tests/config/texts.h"

namespace skyig::config {
namespace {

using testing::HasSubstr;
using testing::Not;

using tests::error_of;
using tests::errors_of;
using tests::kChannel;
using tests::with;

TEST(Config, SmallestFileHasEveryDefault) {
    const LoadResult result = parse_config(with(""), "site.toml");
    ASSERT_TRUE(result) << to_text(result.errors.front());
    const Config& config = *result.config;
    EXPECT_EQ(config.daemon.rate_hz, 60.0);
    EXPECT_EQ(config.host.listen, (UdpAddress{"127.0.0.1", 8004}));
    EXPECT_EQ(config.host.reply_to, (UdpAddress{"127.0.0.1", 8005}));
    EXPECT_EQ(config.host.cigi, (CigiVersion{3, 3}));
    EXPECT_FALSE(config.start.utc);
    EXPECT_EQ(config.display.adaptation_cd_m2, 175.0);
    ASSERT_EQ(config.channels.size(), 1U);
    EXPECT_EQ(config.channels[0].view_id, 1);
    EXPECT_EQ(config.channels[0].left_deg, -30.0);
}

TEST(Config, ReadsEveryKey) {
    const LoadResult result = parse_config(R"(version = 1
[daemon]
rate_hz = 30
[host]
listen = "0.0.0.0:9000"
reply_to = "sender"
allow = ["10.0.0.5", "10.0.0.6"]
cigi = "4.0"
database = "none"
lost_after_s = 2.5
[start]
utc = 2024-02-29T23:59:59.5Z
running = false
latitude_deg = -33.9
longitude_deg = 151.2
height_m = 12
yaw_deg = 90
pitch_deg = -5
roll_deg = 3
[air]
visibility_m = 5000
visibility_contrast = 0.02
temperature_c = -10
pressure_hpa = 990
humidity_pct = 80
wind_m_s = 7
wind_from_deg = 250
[ground]
surface = "sea"
albedo = 0.3
snow_pct = 40
[sky]
sun = false
moon = false
stars = false
star_intensity_pct = 40
[ephemeris]
model = "erfa"
earth_orientation = "finals2000A.all"
[display]
max_luminance_cd_m2 = 200
adaptation_cd_m2 = 50
gamma = 2.4
black_cd_m2 = 0.2
reflected_cd_m2 = 1.5
dither = false
[quality]
error_codes = 1.5
[eye]
operator = "tumblin-safe"
highlight_room = 0.2
shoulder = 0.9
night_colours = false
adapt_to = "view-mean"
adaptation_cd_m2 = 20
adapt_pace = "physiological"
adapt_up_s = 1
adapt_down_s = 20
glare = false
[output]
kind = "headless"
[[channel]]
name = "left"
width_px = 800
height_px = 600
left_deg = -10
right_deg = 40.5
bottom_deg = 1
top_deg = 30
yaw_deg = -60
pitch_deg = 2
roll_deg = -1
offset_m = [1, -0.5, 2]
view_id = 7
group_id = 3
)",
                                           "site.toml");
    ASSERT_TRUE(result) << to_text(result.errors.front());
    const Config& c = *result.config;
    EXPECT_EQ(c.daemon.rate_hz, 30.0);
    EXPECT_EQ(c.host.listen, (UdpAddress{"0.0.0.0", 9000}));
    EXPECT_FALSE(c.host.reply_to);
    EXPECT_THAT(c.host.allow, testing::ElementsAre(UdpAddress{"10.0.0.5", 0}, UdpAddress{"10.0.0.6", 0}));
    EXPECT_EQ(c.host.cigi, (CigiVersion{4, 0}));
    EXPECT_EQ(c.host.database, DatabasePolicy::kNone);
    EXPECT_EQ(c.host.rights.lost_after_s, 2.5);
    EXPECT_EQ(c.start.utc, (UtcDateTime{2024, 2, 29, 23, 59, 59.5}));
    EXPECT_FALSE(c.start.running);
    EXPECT_EQ(c.start.latitude_deg, -33.9);
    EXPECT_EQ(c.start.pitch_deg, -5.0);
    EXPECT_EQ(c.air.visibility_contrast, 0.02);
    EXPECT_EQ(c.air.temperature_c, -10.0);
    EXPECT_EQ(c.air.wind_m_s, 7.0);
    EXPECT_EQ(c.air.wind_from_deg, 250.0);
    EXPECT_EQ(c.ground.surface, Surface::kSea);
    EXPECT_EQ(c.ground.albedo, 0.3);
    EXPECT_EQ(c.ground.snow_pct, 40.0);
    EXPECT_FALSE(c.sky.sun || c.sky.moon || c.sky.stars);
    EXPECT_EQ(c.sky.star_intensity_pct, 40.0);
    EXPECT_EQ(c.ephemeris.model, EphemerisModel::kErfa);
    EXPECT_EQ(c.ephemeris.earth_orientation, "finals2000A.all");
    EXPECT_EQ(c.display.adaptation_cd_m2, 50.0);
    EXPECT_EQ(c.display.gamma, 2.4);
    EXPECT_EQ(c.quality.error_codes, 1.5);
    EXPECT_FALSE(c.quality.error_pct);
    EXPECT_FALSE(c.display.dither);
    EXPECT_EQ(c.display.black_cd_m2, 0.2);
    EXPECT_EQ(c.display.reflected_cd_m2, 1.5);
    EXPECT_EQ(c.eye.tone, ToneOperator::kTumblinSafe);
    EXPECT_EQ(c.eye.highlight_room, 0.2);
    EXPECT_EQ(c.eye.shoulder, 0.9);
    EXPECT_FALSE(c.eye.night_colours);
    EXPECT_EQ(c.eye.adapt_to, AdaptationSource::kViewMean);
    EXPECT_EQ(c.eye.adaptation_cd_m2, 20.0);
    EXPECT_EQ(c.eye.pace, AdaptationPace::kPhysiological);
    EXPECT_EQ(c.eye.adapt_down_s, 20.0);
    EXPECT_FALSE(c.eye.glare);
    ASSERT_EQ(c.channels.size(), 1U);
    EXPECT_EQ(c.channels[0].offset_m, (std::array{1.0, -0.5, 2.0}));
    EXPECT_EQ(c.channels[0].bottom_deg, 1.0);
    EXPECT_EQ(c.channels[0].view_id, 7);
    EXPECT_EQ(c.channels[0].group_id, 3);
}

TEST(Config, EphemerisIsNamedAndItsFileFoundBesideTheSettings) {
    const LoadResult none = parse_config(with(""), "/etc/skyig/site.toml");
    ASSERT_TRUE(none);
    EXPECT_EQ(none.config->ephemeris.model, EphemerisModel::kSeries);
    EXPECT_EQ(none.config->ephemeris.earth_orientation, "");
    const auto file_of = [](std::string_view name, const std::string& settings) {
        const LoadResult result =
            parse_config(with(fmt::format("[ephemeris]\nearth_orientation = \"{}\"", name)), settings);
        return result ? result.config->ephemeris.earth_orientation : to_text(result.errors.front());
    };
    EXPECT_EQ(file_of("eop.csv", "/etc/skyig/site.toml"), "/etc/skyig/eop.csv");
    EXPECT_EQ(file_of("eop.csv", "site.toml"), "eop.csv");
    EXPECT_EQ(file_of("../iers/finals.all", "sites/zrh.toml"), "sites/../iers/finals.all");
    EXPECT_EQ(file_of("/var/lib/finals.all", "/etc/skyig/site.toml"), "/var/lib/finals.all");
    EXPECT_EQ(file_of("", "site.toml"),
              "site.toml:3:21: ephemeris.earth_orientation: is empty; it must name a file, or be left out");
    const std::array<EphemerisModel, 3> models{EphemerisModel::kAlmanac, EphemerisModel::kErfa,
                                               EphemerisModel::kSeries};
    const std::array<std::string_view, 3> names{"almanac", "erfa", "series"};
    for (std::size_t i = 0; i < models.size(); ++i) {
        const LoadResult result =
            parse_config(with(fmt::format("[ephemeris]\nmodel = \"{}\"", names[i])), "site.toml");
        ASSERT_TRUE(result);
        EXPECT_EQ(result.config->ephemeris.model, models[i]);
    }
    EXPECT_THAT(error_of(with("[ephemeris]\nmodel = \"vsop\"")).message, HasSubstr("series"));
    EXPECT_THAT(error_of(with("[ephemeris]\nearth_orientation = 5")).key, "ephemeris.earth_orientation");
    EXPECT_THAT(error_of(with("[ephemeris]\nearth_orientatoin = \"a\"")).message,
                HasSubstr("did you mean \"earth_orientation\""));
}

TEST(Config, RecordingIsNamedFromWhereTheSettingsAre) {
    const auto file_of = [](std::string_view name) {
        const LoadResult result =
            parse_config(with(fmt::format("[record]\nfile = \"{}\"", name)), "sites/zrh.toml");
        return result ? result.config->record.file : to_text(result.errors.front());
    };
    EXPECT_EQ(parse_config(with(""), "site.toml").config->record.file, "");
    EXPECT_EQ(file_of("last.pcapng"), "sites/last.pcapng");
    EXPECT_EQ(file_of("/var/lib/skyig/{time}.pcapng"), "/var/lib/skyig/{time}.pcapng");
    EXPECT_THAT(file_of(""), HasSubstr("zrh.toml:3:8: record.file: is empty"));
    EXPECT_THAT(file_of("{tiem}.pcapng"), HasSubstr("{time} may stand in it once"));
    EXPECT_THAT(file_of("{time}{time}.pcapng"), HasSubstr("{time} may stand in it once"));
    EXPECT_EQ(error_of(with("[record]\nfile = 5")).key, "record.file");
    EXPECT_THAT(error_of(with("[record]\nflie = \"a\"")).message, HasSubstr("did you mean \"file\""));
}

TEST(Config, UnknownKeyIsLocatedAndTheNearestIsSuggested) {
    const ConfigError error = error_of(with("[display]\n  max_luminence_cd_m2 = 80"));
    EXPECT_EQ(error.line, 3);
    EXPECT_EQ(error.column, 3);
    EXPECT_EQ(error.key, "display.max_luminence_cd_m2");
    EXPECT_THAT(error.message, HasSubstr("did you mean \"max_luminance_cd_m2\"?"));
    EXPECT_THAT(to_text(error), HasSubstr("site.toml:3:3: display.max_luminence_cd_m2: unknown key"));
}

TEST(Config, UnknownTableIsSuggestedToo) {
    EXPECT_THAT(error_of(with("[dispaly]\ngamma = 2")).message, HasSubstr("did you mean \"display\"?"));
    EXPECT_THAT(error_of(with("[teapot]\nlid = true")).message, HasSubstr("keys here: \"version\""));
}

TEST(Config, UnknownChannelKeyNamesTheChannel) {
    const ConfigError error = error_of(fmt::format("{}yaw = 3\n", with("")));
    EXPECT_EQ(error.key, "channel[1].yaw");
    EXPECT_EQ(error.line, 11);
    EXPECT_THAT(error.message, HasSubstr("yaw_deg"));
}

TEST(Config, AllErrorsComeAtOnceInTheOrderOfTheText) {
    const std::vector<ConfigError> errors = errors_of(R"(version = 2
[daemon]
rate_hz = 500
[host]
listen = "localhost:8004"
cigi = "3.4"
[start]
latitude_deg = 91
utc = "2026-06-31T12:00:00Z"
[air]
visibility_m = true
[[channel]]
name = "a b"
width_px = 0
height_px = 20000
left_deg = 10
right_deg = 5
bottom_deg = -90
)");
    std::vector<std::string> keys;
    int line = 0;
    for (const ConfigError& error : errors) {
        std::printf("  %s\n", to_text(error).c_str());
        EXPECT_GE(error.line, line);
        line = error.line;
        keys.push_back(error.key);
    }
    EXPECT_THAT(keys, testing::UnorderedElementsAre("version", "daemon.rate_hz", "host.listen", "host.cigi",
                                                    "start.latitude_deg", "start.utc", "air.visibility_m",
                                                    "channel[1].name", "channel[1].width_px",
                                                    "channel[1].height_px", "channel[1].right_deg",
                                                    "channel[1].bottom_deg", "channel[1].top_deg"));
}

TEST(Config, RangesAreSaidWithTheirUnit) {
    EXPECT_EQ(error_of(with("[daemon]\nrate_hz = 0.5")).message, "is 0.5; it must be 1..240 Hz");
    EXPECT_EQ(error_of(with("[start]\nlatitude_deg = -90.1")).message,
              "is -90.1; it must be -90..90 degrees");
    EXPECT_THAT(error_of(with("[daemon]\nrate_hz = nan")).message, HasSubstr("not finite"));
    EXPECT_THAT(error_of(with("[daemon]\nrate_hz = inf")).message, HasSubstr("not finite"));
    EXPECT_THAT(error_of(with("[daemon]\nrate_hz = \"60\"")).message,
                HasSubstr("is text; it must be a number"));
    EXPECT_THAT(error_of(with("[eye]\noperator = \"hybird\"")).message,
                HasSubstr("did you mean \"hybrid\"?"));
    EXPECT_THAT(error_of(with("[sky]\nsun = 1")).message, HasSubstr("it must be true or false"));
    EXPECT_THAT(error_of(with("[display]\ngamma = \"rec709\"")).message,
                HasSubstr("\"srgb\" or a number 1..3"));
}

TEST(Config, VersionIsRequired) {
    const ConfigError error = error_of(kChannel);
    EXPECT_EQ(error.key, "version");
    EXPECT_THAT(error.message, HasSubstr("is missing"));
    EXPECT_EQ(error_of(fmt::format("version = 3\n{}", kChannel)).message,
              "is 3; this program reads version 1");
}

TEST(Config, AtLeastOneChannelAndAtMostSixteen) {
    EXPECT_EQ(error_of("version = 1\n").key, "channel");
    EXPECT_THAT(error_of("version = 1\n[channel]\nname = \"a\"\n").message, HasSubstr("double brackets"));
    std::string many = "version = 1\n";
    for (int i = 0; i < 17; ++i)
        many += kChannel;
    EXPECT_THAT(error_of(many).message, HasSubstr("17 times; at most 16"));
}

TEST(Config, FrustaWithoutAreaOrBeyondReachAreRefused) {
    const auto channel = [](double left, double right) {
        return fmt::format(
            "version = 1\n[[channel]]\nname = \"a\"\nwidth_px = 8\nheight_px = 8\nleft_deg = {}\n"
            "right_deg = {}\nbottom_deg = -5\ntop_deg = 5\n",
            left, right);
    };
    EXPECT_THAT(error_of(channel(10, 10)).message, HasSubstr("no area"));
    EXPECT_EQ(error_of(channel(10, 10)).line, 7);
    EXPECT_EQ(error_of(channel(30, -30)).key, "channel[1].right_deg");
    EXPECT_EQ(error_of(channel(-87.6, 30)).key, "channel[1].left_deg");
    EXPECT_TRUE(parse_config(channel(-87.5, 87.5), "a"));
    EXPECT_TRUE(parse_config(channel(10, 40), "a"));
}

TEST(Config, ChannelsAreComparedWithOneAnother) {
    const auto second = [](std::string_view lines) {
        return fmt::format(
            "{}{}{}", with(""),
            "[[channel]]\nwidth_px = 8\nheight_px = 8\nleft_deg = -5\nright_deg = 5\nbottom_deg = -5\n"
            "top_deg = 5\n",
            lines);
    };
    EXPECT_THAT(error_of(second("name = \"centre\"\n")).message, HasSubstr("names must differ"));
    const ConfigError same_view = error_of(second("name = \"b\"\nview_id = 1\n"));
    EXPECT_EQ(same_view.key, "channel[2].view_id");
    EXPECT_THAT(same_view.message, HasSubstr("view ids must differ"));
    const ConfigError far = error_of(second("name = \"b\"\noffset_m = [0, 30, 40.1]\n"));
    EXPECT_EQ(far.key, "channel[2].offset_m");
    EXPECT_THAT(far.message, HasSubstr("50.08 m"));
    EXPECT_TRUE(parse_config(second("name = \"b\"\noffset_m = [0, 30, 40]\n"), "a"));
    EXPECT_THAT(error_of(second("name = \"b\"\noffset_m = [0, 30]\n")).message,
                HasSubstr("[forward, right, down]"));
}

TEST(Config, DatesMayBeTextOrTomlAndMustBeUtc) {
    const auto utc = [](std::string_view value) {
        return parse_config(with(fmt::format("[start]\nutc = {}", value)), "a");
    };
    ASSERT_TRUE(utc("\"2026-06-21T19:30Z\""));
    EXPECT_EQ(utc("\"2026-06-21T19:30Z\"").config->start.utc, (UtcDateTime{2026, 6, 21, 19, 30, 0.0}));
    ASSERT_TRUE(utc("\"2026-06-21T19:30:15.25Z\""));
    EXPECT_EQ(utc("\"2026-06-21T19:30:15.25Z\"").config->start.utc->second, 15.25);
    EXPECT_EQ(utc("2026-06-21T19:30:00Z").config->start.utc, (UtcDateTime{2026, 6, 21, 19, 30, 0.0}));
    EXPECT_FALSE(utc("\"now\"").config->start.utc);
    EXPECT_FALSE(utc("2026-06-21T19:30:00+02:00"));
    EXPECT_FALSE(utc("2026-06-21T19:30:00"));
    EXPECT_FALSE(utc("\"2026-06-21T19:30:00\""));
    EXPECT_FALSE(utc("\"2026-06-21T24:00:00Z\""));
    EXPECT_FALSE(utc("\"2025-02-29T12:00:00Z\""));
    EXPECT_FALSE(utc("\"1899-12-31T12:00:00Z\""));
    EXPECT_FALSE(utc("2101-01-01T00:00:00Z"));
    EXPECT_FALSE(utc("\"2026-06-21T19:3 :00Z\""));
    EXPECT_FALSE(utc("\"2026-06-21T19:30:00.Z\""));
    EXPECT_FALSE(utc("20260621"));
}

TEST(Config, AddressesAreCheckedToTheLastDigit) {
    for (const char* bad : {"127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.256:1", "127.0.0:1",
                            "1.2.3.4.5:6", "01.2.3.4:5", ":8004", "127.0.0.1:80 04", "127.0.0.1:-1"}) {
        EXPECT_FALSE(parse_config(with(fmt::format("[host]\nlisten = \"{}\"", bad)), "a")) << bad;
    }
    EXPECT_TRUE(parse_config(with("[host]\nlisten = \"127.0.0.1:0\""), "a"));
    EXPECT_FALSE(parse_config(with("[host]\nreply_to = \"127.0.0.1:0\""), "a"));
    EXPECT_FALSE(parse_config(with("[host]\nallow = []"), "a"));
    EXPECT_FALSE(parse_config(with("[host]\nallow = [\"example\", 5]"), "a"));
    EXPECT_EQ(errors_of(with("[host]\nallow = [\"example\", 5]")).size(), 2U);
}

TEST(Config, SyntaxErrorsAreLocated) {
    const ConfigError error = error_of("version = 1\n[daemon\nrate_hz = 60\n");
    EXPECT_GE(error.line, 2);
    EXPECT_LE(error.line, 3);
    EXPECT_GT(error.column, 0);
    EXPECT_FALSE(error.message.empty());
    EXPECT_EQ(error_of("version = 1\nversion = 1\n").line, 2);
    EXPECT_FALSE(errors_of("version = \"\xff\xfe\"").empty());
}

std::string repeated(std::string_view part, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += part;
    return text;
}

TEST(Config, KeysNestedTooDeepAreRefusedWithTheirLine) {
    const std::string deep = repeated("a.", 100'000) + "a";
    for (const char* form : {"{} = 1", "[{}]", "[[{}]]", "x = {{{} = 1}}", R"(x = ["""q""""", {{{} = 1}}])",
                             R"('k' . "\"" . {} = 1)"}) {
        const std::string line = fmt::format(fmt::runtime(form), deep);
        const LoadResult result = parse_config(fmt::format("version = 1\n# it's\n{}\n", line), "site.toml");
        ASSERT_EQ(result.errors.size(), 1U) << form;
        EXPECT_EQ(result.errors[0].line, 3) << form;
        EXPECT_GT(result.errors[0].column, 60) << form;
        EXPECT_THAT(result.errors[0].message, HasSubstr("nested too deep")) << form;
    }
    EXPECT_EQ(error_of(fmt::format("s = \"\"\"\n\n\"\"\"\n{} = 1\n", deep)).line, 4);
}

TEST(Config, DotsInStringsAndCommentsAreFree) {
    const std::string dots = repeated(".", 200);
    EXPECT_TRUE(parse_config(with(fmt::format("# {}\n[host] # {}", dots, dots)), "a"));
    for (const char* form : {R"("\"{}")", "'{}'", "\"\"\"{}\n.\"\"\"", "''''{}'''"}) {
        const std::string text = fmt::format(fmt::runtime(form), dots);
        // Only the key is wrong.
        EXPECT_EQ(error_of(with(fmt::format("[host]\nnothing = {}", text))).key, "host.nothing");
    }
    EXPECT_THAT(error_of(with(repeated("a.", 32) + "a = 1")).message, Not(HasSubstr("nested too deep")));
    EXPECT_THAT(error_of(with(repeated("a.", 33) + "a = 1")).message, HasSubstr("nested too deep"));
}

TEST(Config, DeepestNestingOverManyLinesIsSurvived) {
    const std::string open = fmt::format("[\n{{{}a = ", repeated("a.", 32));
    for (const std::size_t levels : {7U, 125U, 1000U}) {
        const std::string text = fmt::format("[{}b]\nx = {}1{}", repeated("b.", 32), repeated(open, levels),
                                             repeated("}\n]", levels));
        const std::string told = to_text(errors_of(with(text)).at(0));
        std::printf("  %s\n", told.substr(0, 200).c_str());
        EXPECT_EQ(told.find("nested value depth") == std::string::npos, levels == 7U);
    }
}

TEST(Config, AnyMutilatedFileGivesAConfigOrErrors) {
    std::FILE* file = std::fopen(SKYIG_SOURCE_DIR "/config/examples/three-channels.toml", "rb");
    ASSERT_NE(file, nullptr);
    std::string original(8192, '\0');
    original.resize(std::fread(original.data(), 1, original.size(), file));
    std::fclose(file);
    std::mt19937 random(20260621);
    const auto below = [&random](std::size_t bound) { return static_cast<std::size_t>(random()) % bound; };
    int good = 0, bad = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = original;
        for (std::size_t n = below(4) + 1; n > 0; --n) {
            const std::size_t at = below(text.size() - 1);
            if (below(3) == 0) {
                text.erase(at, below(40));
            } else if (below(2) == 0) {
                text[at] = static_cast<char>(below(256));
            } else {
                text.insert(at, original.substr(below(original.size()), below(40)));
            }
        }
        const LoadResult result = parse_config(text, "a");
        EXPECT_NE(result.config.has_value(), !result.errors.empty());
        ++(result ? good : bad);
    }
    std::printf("  %d still good, %d refused\n", good, bad);
    EXPECT_GT(good, 0);
    EXPECT_GT(bad, 0);
}

TEST(Config, FilesThatCannotBeReadSayWhy) {
    const LoadResult missing = load_config("no/such/file.toml");
    ASSERT_EQ(missing.errors.size(), 1U);
    EXPECT_EQ(to_text(missing.errors[0]), "no/such/file.toml: cannot be opened: No such file or directory");
    const LoadResult folder = load_config(SKYIG_SOURCE_DIR);
    ASSERT_EQ(folder.errors.size(), 1U);
    EXPECT_THAT(folder.errors[0].message, HasSubstr("cannot be"));
    EXPECT_THAT(load_config("/dev/zero").errors[0].message, HasSubstr("larger than 256 KiB"));
}

TEST(Config, ExamplesLoadAndDescribeThemselves) {
    const LoadResult one = load_config(SKYIG_SOURCE_DIR "/config/examples/one-channel.toml");
    ASSERT_TRUE(one) << to_text(one.errors.front());
    EXPECT_EQ(describe(*one.config),
              "ok: 1 channel, CIGI 3.3+4.0 on udp 127.0.0.1:8004, headless, status on http://127.0.0.1:8006");
    const LoadResult three = load_config(SKYIG_SOURCE_DIR "/config/examples/three-channels.toml");
    ASSERT_TRUE(three) << to_text(three.errors.front());
    EXPECT_EQ(
        describe(*three.config),
        "ok: 3 channels, CIGI 3.3+4.0 on udp 127.0.0.1:8004, headless, status on http://127.0.0.1:8006");
    ASSERT_EQ(three.config->channels.size(), 3U);
    EXPECT_EQ(three.config->channels[0].yaw_deg, -60.0);
    EXPECT_EQ(three.config->channels[2].yaw_deg, 60.0);
    for (const Channel& channel : three.config->channels) {
        EXPECT_EQ(channel.left_deg, -30.0);
        const double rad = 3.14159265358979323846 / 180.0;
        const double square = std::tan(channel.right_deg * rad) * channel.height_px / channel.width_px;
        EXPECT_NEAR(std::tan(channel.top_deg * rad), square, 1e-4) << "pixels are not square";
    }
}

TEST(Config, DefaultConfigHasOneChannel) {
    const Config config = default_config();
    ASSERT_EQ(config.channels.size(), 1U);
    EXPECT_EQ(config.channels[0].name, "centre");
    EXPECT_EQ(config.channels[0].width_px, 1280);
    EXPECT_EQ(config.channels[0].right_deg, 30.0);
}

}  // namespace
}  // namespace skyig::config
