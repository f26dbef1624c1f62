// Each recording here is replayed twice: both draw the same, and the log is the one that was reviewed.
// SKYIG_REBUILD_REPLAYS=1 writes the logs anew (see README.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/e2e/process.h"
#include "tests/e2e/rig.h"

namespace skyig::tests {
namespace {

struct Case {
    /// Of NAME.toml and NAME.events.
    std::string name;
    /// Under the repository's root.
    std::string recording;
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

class ReplayEvents : public ::testing::TestWithParam<Case> {};

TEST_P(ReplayEvents, AreAsReviewedAndThePicturesRepeat) {
    const std::string here = SKYIG_SOURCE_DIR "/tests/replay/" + GetParam().name;
    const std::string capture = SKYIG_SOURCE_DIR "/" + GetParam().recording;
    const Replayed first = replay(SKYIGD_PROGRAM, here + ".toml", capture);
    const Replayed second = replay(SKYIGD_PROGRAM, here + ".toml", capture);
    ASSERT_EQ(first.finished.status, 0) << first.finished.err;
    ASSERT_EQ(second.finished.status, 0) << second.finished.err;
    EXPECT_TRUE(first.hashes == second.hashes) << "drawn otherwise from one replay to the next";
    EXPECT_EQ(first.events, second.events);
    const std::string events = events_of_frames(first.events);
    std::printf("%s: %ld pictures, %ld lines of log\n", GetParam().name.c_str(), line_count(first.hashes),
                line_count(events));
    EXPECT_GT(line_count(first.hashes), 0);
    if (std::getenv("SKYIG_REBUILD_REPLAYS") != nullptr) std::ofstream(here + ".events") << events;
    EXPECT_EQ(events, read_text(here + ".events"));
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, ReplayEvents,
    ::testing::Values(Case{"host_and_instructor", "tests/replay/host_and_instructor.pcapng"},
                      Case{"flightgear", "tests/data/flights/fg_native_fdm_2s.pcap"},
                      Case{"cockpit_bus", "tests/data/canaerospace/canaerospace_golden.log"}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace skyig::tests
