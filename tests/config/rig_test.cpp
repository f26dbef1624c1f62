// [rig], its machines, and which of them draws a channel.
#include "config/rig.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.h"
#include "tests/config/texts.h"

namespace skyig::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view kMachines = R"([[rig.node]]
name = "main"
address = "192.168.7.11"
[[rig.node]]
name = "side"
address = "192.168.7.12"
interface = "eth1"
)";

/// A rig of two machines; "main" draws the one channel.
std::string rig_file(std::string_view lines, std::string_view machines = kMachines,
                     std::string_view channel_lines = "node = \"main\"\n") {
    return fmt::format("version = 1\n[rig]\n{}\n{}{}{}", lines, machines, tests::kChannel, channel_lines);
}

constexpr std::string_view kNeeded = "leader = \"main\"\nkey_file = \"rig.key\"";

ConfigError error_with(std::string_view lines) {
    return tests::error_of(rig_file(fmt::format("{}\n{}", kNeeded, lines)));
}

TEST(RigSettings, AreNoneOnAMachineAlone) {
    EXPECT_FALSE(parse_config(tests::with(""), "site.toml").config->rig);
}

TEST(RigSettings, AreTakenWithTheirDefaults) {
    const LoadResult result =
        parse_config(rig_file(fmt::format("{}\nstand_ins = [\"side\"]", kNeeded)), "/etc/skyig/site.toml");
    ASSERT_TRUE(result);
    const Rig& rig = *result.config->rig;
    EXPECT_EQ(rig.leader, "main");
    EXPECT_THAT(rig.stand_ins, ElementsAre("side"));
    EXPECT_EQ(rig.domain, 0);
    EXPECT_DOUBLE_EQ(rig.wait_ms, 10.0);
    EXPECT_EQ(rig.key_file, "/etc/skyig/rig.key");
    ASSERT_EQ(rig.nodes.size(), 2U);
    EXPECT_EQ(rig.nodes[1].address, "192.168.7.12");
    EXPECT_EQ(rig.nodes[1].interface, "eth1");
    EXPECT_EQ(rig.find("side"), &rig.nodes[1]);
    EXPECT_EQ(rig.find("rear"), nullptr);
    EXPECT_EQ(result.config->channels[0].node, "main");
}

TEST(RigSettings, NeedALeaderAKeyAndAMachine) {
    EXPECT_EQ(tests::error_of(rig_file("leader = \"main\"")).key, "rig.key_file");
    EXPECT_EQ(tests::error_of(rig_file("key_file = \"k\"")).key, "rig.leader");
    EXPECT_EQ(tests::error_of(rig_file("leader = \"main\"\nkey_file = \"\"")).key, "rig.key_file");
    EXPECT_FALSE(tests::errors_of(rig_file(kNeeded, "")).empty());
}

TEST(RigSettings, NameOnlyMachinesThatThereAre) {
    const ConfigError leader = tests::error_of(rig_file("leader = \"rear\"\nkey_file = \"k\""));
    EXPECT_EQ(leader.key, "rig.leader");
    EXPECT_EQ(leader.line, 3);
    EXPECT_THAT(leader.message, HasSubstr("is \"rear\""));
    EXPECT_THAT(error_with("stand_ins = [\"rear\"]").message, HasSubstr("\"rear\", which is none"));
    EXPECT_THAT(error_with("stand_ins = [\"main\"]").message, HasSubstr("\"main\", which leads"));
    EXPECT_THAT(error_with("stand_ins = [\"side\", \"side\"]").message, HasSubstr("which is there twice"));
    EXPECT_THAT(error_with("stand_ins = \"side\"").message, HasSubstr("it must be a list of names"));
    EXPECT_THAT(error_with("stand_ins = [1]").message, HasSubstr("it must hold names"));
}

TEST(RigSettings, StayInTheirRanges) {
    EXPECT_EQ(error_with("domain = 231").key, "rig.domain");
    EXPECT_EQ(error_with("domain = -1").key, "rig.domain");
    EXPECT_EQ(error_with("wait_ms = 0.05").key, "rig.wait_ms");
    EXPECT_EQ(error_with("wait_ms = 2000").key, "rig.wait_ms");
    EXPECT_EQ(error_with("port = 7400").key, "rig.port");
}

TEST(RigSettings, MachinesDifferInNameAndAddress) {
    const auto with_third = [](std::string_view lines) {
        return tests::error_of(rig_file(kNeeded, fmt::format("{}[[rig.node]]\n{}", kMachines, lines)));
    };
    EXPECT_THAT(with_third("name = \"side\"\naddress = \"192.168.7.13\"\n").message,
                HasSubstr("names must differ"));
    EXPECT_THAT(with_third("name = \"rear\"\naddress = \"192.168.7.12\"\n").message,
                HasSubstr("addresses must differ"));
    const ConfigError form = with_third("name = \"rear\"\naddress = \"rear.local\"\n");
    EXPECT_EQ(form.key, "rig.node[3].address");
    EXPECT_THAT(form.message, HasSubstr("it must be an IPv4 address"));
    EXPECT_THAT(with_third("name = \"rear seat\"\naddress = \"192.168.7.13\"\n").message,
                HasSubstr("letters, digits"));
    EXPECT_EQ(with_third("name = \"rear\"\n").key, "rig.node[3].address");
}

TEST(RigSettings, EveryChannelIsOneMachines) {
    const ConfigError none = tests::error_of(rig_file(kNeeded, kMachines, ""));
    EXPECT_EQ(none.key, "channel[1].node");
    EXPECT_THAT(tests::error_of(rig_file(kNeeded, kMachines, "node = \"rear\"\n")).message,
                HasSubstr("is \"rear\"; it must be a machine's name"));
    EXPECT_THAT(tests::error_of(tests::with("") + "node = \"main\"\n").message,
                HasSubstr("there is no [rig]"));
}

}  // namespace
}  // namespace skyig::config
