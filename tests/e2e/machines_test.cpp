// A rig of several machines, each a network namespace of this one: what they show is what one machine shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/e2e/machines.h"
#include "tests/e2e/process.h"
#include "tests/e2e/rig.h"

namespace skyig::tests {
namespace {

using ::testing::HasSubstr;

constexpr const char* kFlight = SKYIG_TEST_DATA "/flights/fg_native_fdm_2s.pcap";
constexpr const char* kKey = "00112233445566778899aabbccddeeff\n";
constexpr const char* kFlightGear =
    "[host]\nenabled = false\n[[source]]\nname = \"flight\"\nkind = \"fgnetfdm\"\nlisten = "
    "\"127.0.0.1:5500\"\n"
    "[status]\nenabled = false\n";

std::set<std::string> lines_of(const std::string& text) {
    std::set<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.insert(line);
    return lines;
}

struct Scenery {
    std::string name;
    std::string utc;
    std::string more;
};

void PrintTo(const Scenery& scenery, std::ostream* out) {
    *out << scenery.name;
}

class MachinesTest : public ::testing::TestWithParam<Scenery> {};

/// What a machine of a rig has done.
struct Part {
    std::unique_ptr<Process> process;
    std::string hashes_path;
};

Part start(const Machines& machines, const ScratchDirectory& scratch, const std::string& config, int machine,
           const std::vector<std::string>& more) {
    const std::string name = kMachineNames[machine];
    const std::string hashes = scratch.file("hashes-" + name);
    std::vector<std::string> command{SKYIGD_PROGRAM, "--config", config,     "--headless",
                                     "--node",       name,       "--hashes", hashes};
    command.insert(command.end(), more.begin(), more.end());
    return {std::make_unique<Process>(machines.on(machine, command)), hashes};
}

TEST_P(MachinesTest, DrawTheSamePicturesAsOneMachine) {
    const Machines machines(3);
    if (!machines.fault().empty()) GTEST_SKIP() << "no network namespaces here: " << machines.fault();
    const ScratchDirectory scratch;
    scratch.write("key", kKey);
    const std::string config = scratch.write(
        "rig.toml", rig_toml({.utc = GetParam().utc, .more = kFlightGear + GetParam().more}, "key"));
    const std::vector<std::string> frames{"--frames", "60"};
    const Replayed alone = replay(SKYIGD_PROGRAM, config, kFlight, {"--frames", "60", "--headless"});
    ASSERT_EQ(alone.finished.status, 0) << alone.finished.err;

    Part left = start(machines, scratch, config, 1, frames);
    Part right = start(machines, scratch, config, 2, frames);
    Part lead = start(machines, scratch, config, 0, {"--replay", kFlight, "--frames", "60"});
    std::string together;
    for (Part* part : {&lead, &left, &right}) {
        const Finished finished = part->process->wait(std::chrono::seconds(60));
        EXPECT_EQ(finished.status, 0) << finished.err;
        together += read_text(part->hashes_path);
    }
    const std::set<std::string> expected = lines_of(alone.hashes);
    const std::set<std::string> got = lines_of(together);
    EXPECT_EQ(expected.size(), 180U);
    EXPECT_EQ(got.size(), 180U);
    long alike = 0;
    for (const std::string& line : got)
        alike += static_cast<long>(expected.count(line));
    std::printf("%s: %ld of %zu pictures alike\n", GetParam().name.c_str(), alike, expected.size());
    EXPECT_TRUE(got == expected);
}

INSTANTIATE_TEST_SUITE_P(
    DayNightAndClouds, MachinesTest,
    ::testing::Values(Scenery{"noon", "2026-06-21T12:00:00Z", ""},
                      Scenery{"night", "2026-12-21T00:30:00Z", ""},
                      Scenery{"clouds", "2026-06-21T14:00:00Z",
                              "[weather]\npreset = \"broken\"\n[air]\nwind_m_s = 20\nwind_from_deg = 240\n"}),
    [](const auto& scenery) { return scenery.param.name; });

}  // namespace
}  // namespace skyig::tests
