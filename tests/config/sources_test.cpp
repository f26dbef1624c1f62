// [host] and [[source]]: who is heard, where, and about what; [status]: each mistake with its own error.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.h"

namespace skyig::config {
namespace {

using testing::HasSubstr;

std::string site(std::string_view lines) {
    return fmt::format(
        "version = 1\n{}\n[[channel]]\nname = \"centre\"\nwidth_px = 64\nheight_px = 48\nleft_deg = -30\n"
        "right_deg = 30\nbottom_deg = -25\ntop_deg = 25\n",
        lines);
}

Config good(std::string_view lines) {
    const LoadResult result = parse_config(site(lines), "site.toml");
    for (const ConfigError& error : result.errors)
        ADD_FAILURE() << to_text(error);
    return result.config ? *result.config : default_config();
}

std::string error_of(std::string_view lines) {
    const LoadResult result = parse_config(site(lines), "site.toml");
    EXPECT_EQ(result.errors.size(), 1U) << lines;
    return result.errors.empty() ? std::string{} : to_text(result.errors.front());
}

bool owns(const Rights& rights, Aspect aspect) {
    return rights.owns.test(static_cast<std::size_t>(aspect));
}

constexpr std::string_view kInstructor = R"([[source]]
name = "instructor"
kind = "cigi"
listen = "127.0.0.1:8010"
)";

TEST(Sources, HostOwnsEverythingByDefault) {
    const Config config = good("");
    EXPECT_TRUE(config.host.enabled);
    EXPECT_TRUE(config.host.rights.owns.all());
    EXPECT_EQ(config.host.rights.priority, 50);
    EXPECT_TRUE(config.sources.empty());
}

TEST(Status, PortIsOnUnlessTheFileSaysOtherwise) {
    const Status usual = good("").status;
    EXPECT_TRUE(usual.enabled);
    EXPECT_FALSE(usual.listen_given);
    EXPECT_EQ(usual.listen, (UdpAddress{"127.0.0.1", 8006}));
    const Status given = good("[status]\nlisten = \"0.0.0.0:9100\"").status;
    EXPECT_TRUE(given.listen_given);
    EXPECT_EQ(given.listen, (UdpAddress{"0.0.0.0", 9100}));
    const Config off = good("[status]\nenabled = false");
    EXPECT_FALSE(off.status.enabled);
    EXPECT_THAT(describe(off), HasSubstr("no status port"));
    EXPECT_THAT(describe(good("[status]\nlisten = \"127.0.0.1:9100\"")),
                HasSubstr("status on http://127.0.0.1:9100"));
}

TEST(Status, MistakesSayWhatWouldBeRight) {
    EXPECT_THAT(
        error_of("[status]\nlisten = \"localhost:8006\""),
        HasSubstr("site.toml:3:10: status.listen: is \"localhost:8006\"; it must be an IPv4 address and a "
                  "port, such as \"127.0.0.1:8006\""));
    EXPECT_THAT(error_of("[status]\nlisten = \"127.0.0.1:65536\""), HasSubstr("status.listen"));
    EXPECT_THAT(error_of("[status]\nenabled = 1"), HasSubstr("status.enabled"));
    EXPECT_THAT(error_of("[status]\nport = 8006"), HasSubstr("status.port: unknown key"));
    EXPECT_THAT(error_of("[staus]\nenabled = true"), HasSubstr("did you mean \"status\"?"));
}

TEST(Sources, EveryKeyOfACigiSourceIsRead) {
    const Config config = good(fmt::format(
        "{}allow = [\"10.0.0.1\", \"10.0.0.2:40000\"]\nowns = [\"time\", \"weather\"]\npriority = 60\n"
        "stale_after_s = 2\nlost_after_s = 5\n[host]\nowns = [\"control\", \"ownship\", \"views\"]",
        kInstructor));
    ASSERT_EQ(config.sources.size(), 1U);
    const Source& source = config.sources[0];
    EXPECT_EQ(source.name, "instructor");
    EXPECT_EQ(source.kind, SourceKind::kCigi);
    EXPECT_EQ(source.listen, (UdpAddress{"127.0.0.1", 8010}));
    EXPECT_THAT(source.allow, testing::ElementsAre(UdpAddress{"10.0.0.1", 0}, UdpAddress{"10.0.0.2", 40000}));
    EXPECT_TRUE(owns(source.rights, Aspect::kTime));
    EXPECT_FALSE(owns(source.rights, Aspect::kControl));
    EXPECT_EQ(source.rights.priority, 60);
    EXPECT_EQ(source.rights.stale_after_s, 2.0);
    EXPECT_EQ(source.rights.lost_after_s, 5.0);
    EXPECT_FALSE(owns(config.host.rights, Aspect::kWeather));
}

TEST(Sources, BusAndFlightModelOwnWhatTheyCanSay) {
    const Config config = good(R"([host]
enabled = false
[[source]]
name = "bus"
kind = "canaerospace"
interface = "can0"
bcd_time = true
month_base = 0
identifiers = { latitude = 1500, longitude = 1501 }
[[source]]
name = "fg"
kind = "fgnetfdm"
listen = "127.0.0.1:5500"
)");
    EXPECT_FALSE(config.host.enabled);
    ASSERT_EQ(config.sources.size(), 2U);
    EXPECT_EQ(config.sources[0].interface, "can0");
    EXPECT_TRUE(config.sources[0].bcd_time);
    EXPECT_EQ(config.sources[0].month_base, 0);
    EXPECT_EQ(config.sources[0].identifiers.at("longitude"), 1501);
    EXPECT_TRUE(owns(config.sources[0].rights, Aspect::kWeather));
    EXPECT_FALSE(owns(config.sources[0].rights, Aspect::kControl));
    EXPECT_FALSE(owns(config.sources[1].rights, Aspect::kWeather));
    EXPECT_TRUE(owns(config.sources[1].rights, Aspect::kOwnship));
}

TEST(Sources, EachMistakeIsNamedWithWhatWouldBeRight) {
    EXPECT_THAT(error_of("[[source]]\nkind = \"cigi\"\nlisten = \"127.0.0.1:1\""),
                HasSubstr("source[1].name: is missing"));
    EXPECT_THAT(error_of("[[source]]\nname = \"a b\"\nkind = \"cigi\"\nlisten = \"127.0.0.1:1\""),
                HasSubstr("source[1].name: is \"a b\"; it must be 1..32 of letters"));
    EXPECT_THAT(error_of("[[source]]\nname = \"a\"\nkind = \"dis\"\nlisten = \"127.0.0.1:1\""),
                HasSubstr("source[1].kind"));
    EXPECT_THAT(error_of(fmt::format("{}owns = [\"sky\"]", kInstructor)),
                HasSubstr("source[1].owns: holds \"sky\"; it must hold some of \"control\""));
    EXPECT_THAT(error_of(fmt::format("{}owns = []", kInstructor)),
                HasSubstr("source[1].owns: must be a list"));
    EXPECT_THAT(error_of(fmt::format("{}allow = [\"10.0.0.1:0\"]", kInstructor)),
                HasSubstr("source[1].allow: holds \"10.0.0.1:0\""));
    EXPECT_THAT(error_of(fmt::format("{}interface = \"can0\"", kInstructor)), HasSubstr("unknown key"));
    EXPECT_THAT(error_of("[[source]]\nname = \"bus\"\nkind = \"canaerospace\""),
                HasSubstr("source[1].interface: is missing"));
    EXPECT_THAT(error_of("[[source]]\nname = \"bus\"\nkind = \"canaerospace\"\ninterface = \"can0\"\n"
                         "owns = [\"views\"]"),
                HasSubstr("source[1].owns: holds \"views\", of which canaerospace says nothing"));
    EXPECT_THAT(error_of("[[source]]\nname = \"bus\"\nkind = \"canaerospace\"\ninterface = \"can0\"\n"
                         "identifiers = { latitude = 2032 }"),
                HasSubstr("source[1].identifiers.latitude: must be a CAN identifier, 0..2031"));
    EXPECT_THAT(error_of("source = 3"), HasSubstr("source: must be one or more tables"));
}

TEST(Sources, NamesDifferAndAPortHearsOneProtocol) {
    EXPECT_THAT(error_of(fmt::format("{}{}", kInstructor, kInstructor)),
                HasSubstr("source[2].name: is \"instructor\" like that of another"));
    EXPECT_THAT(error_of("[[source]]\nname = \"host\"\nkind = \"cigi\"\nlisten = \"127.0.0.1:8010\""),
                HasSubstr("source[1].name: is \"host\""));
    EXPECT_THAT(error_of("[[source]]\nname = \"fg\"\nkind = \"fgnetfdm\"\nlisten = \"127.0.0.1:8004\""),
                HasSubstr("source[1].listen: is that of \"host\", which speaks cigi"));
    // Two of one protocol may share a port: their senders tell them apart.
    good(
        "[[source]]\nname = \"instructor\"\nkind = \"cigi\"\nlisten = \"127.0.0.1:8004\"\n"
        "allow = [\"127.0.0.1:40000\"]");
}

}  // namespace
}  // namespace skyig::config
