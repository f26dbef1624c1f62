// A rig of three machines over a network that loses, delays and reorders: what its nodes show is what the
// leader said, or the picture before, and that is counted. Runs in a guest whose kernel has such a network.
#include <gtest/gtest.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "server/pace.h"
#include "tests/support/rig_program.h"

namespace skyig::tests {
namespace {

using server::rig::Follower;
using server::rig::FrameState;

constexpr int kFrames = 240;
constexpr int kNodes = 2;

/// A scene that tells which frame's it is in every part.
FrameState state_of(std::uint64_t frame) {
    FrameState state;
    const auto number = static_cast<double>(frame);
    state.scene.frame_number = frame;
    state.scene.time_s = number / RigProgram::kRate_hz;
    state.scene.eye.height_m = 1000.0 + number / 3.0;
    state.scene.weather.cloud_count = 3;
    for (render::CloudLayer& layer : state.scene.weather.clouds)
        layer.base_m = 500.0 + number / 7.0;
    state.scene.overlay.lines[0].say(std::to_string(frame));
    return state;
}

bool is_state_of(const FrameState& state, std::uint64_t frame) {
    const FrameState wanted = state_of(frame);
    return state.scene.time_s == wanted.scene.time_s &&
           state.scene.eye.height_m == wanted.scene.eye.height_m &&
           state.scene.weather.clouds[2] == wanted.scene.weather.clouds[2] &&
           state.scene.overlay.lines[0].text() == wanted.scene.overlay.lines[0].text();
}

/// What a node has done, as it is told to the test.
struct Told {
    int shown = 0;
    int wrong = 0;
    int backwards = 0;
    std::uint64_t repeats = 0;
    std::uint64_t late = 0;
    std::uint64_t missed = 0;
    std::uint64_t unreadable = 0;
};

Told run_node(int node) {
    RigProgram program(node, kNodes, 170);
    Told told;
    std::uint64_t last = 0;
    while (program.machine && last < kFrames) {
        int idles = 0;
        if (!program.machine->await_work([&idles] { return ++idles < 300; })) break;
        Follower& follower = program.machine->follower();
        const std::uint64_t frame = follower.newest().scene.frame_number;
        told.wrong += is_state_of(follower.newest(), frame) ? 0 : 1;
        follower.clear();
        follower.tell_drawn(frame, 0);
        if (program.machine->await_word(frame, [] { return true; }) != Follower::Word::kRepeat) {
            ++told.shown;
            told.backwards += frame <= last ? 1 : 0;
        }
        last = frame;
    }
    if (program.machine) {
        const auto& counts = program.machine->follower().counts();
        told.repeats = counts.repeats;
        told.late = counts.late;
        told.missed = counts.missed;
        told.unreadable = counts.unreadable + counts.unsealed;
    }
    return told;
}

std::string spoil_network() {
    utsname kernel{};
    uname(&kernel);
    const std::string module =
        std::string("/usr/lib/uml/modules/") + kernel.release + "/kernel/net/sched/sch_netem.ko";
    const std::string command =
        "insmod " + module + " && tc qdisc add dev lo root netem loss 1% delay 5ms 5ms reorder 10% 50%";
    return std::system(command.c_str()) == 0 ? "" : command;
}

TEST(RigOnABadNetwork, ShowsNoWrongFrameAndCountsWhatItRepeats) {
    ASSERT_EQ(spoil_network(), "");
    std::array<std::array<int, 2>, kNodes> pipes{};
    std::array<pid_t, kNodes> children{};
    for (int i = 0; i < kNodes; ++i) {
        const auto at = static_cast<std::size_t>(i);
        ASSERT_EQ(pipe(pipes[at].data()), 0);
        children[at] = fork();
        if (children[at] == 0) {
            const Told told = run_node(i + 1);
            const bool written = write(pipes[at][1], &told, sizeof(told)) == sizeof(told);
            std::_Exit(written ? 0 : 1);
        }
        close(pipes[at][1]);
    }
    RigProgram lead(0, kNodes, 170);
    ASSERT_TRUE(lead.machine) << lead.link.error();
    ASSERT_TRUE(lead.await_nodes(30.0));
    server::ClockPace pace(lead.clock, RigProgram::kRate_hz);
    const std::int64_t start_ns = lead.clock.monotonic_ns();
    for (std::uint64_t frame = 1; frame <= kFrames; ++frame) {
        (void)pace.next();
        lead.machine->leader().tell(state_of(frame));
        lead.machine->leader().await(frame);
        lead.machine->leader().tell_show(frame);
    }
    const double rate_hz = kFrames / (static_cast<double>(lead.clock.monotonic_ns() - start_ns) * 1e-9);
    std::printf("%.1f of 30 Hz, waits p50 %.1f ms p99 %.1f ms, %ju frames shown without some node\n", rate_hz,
                lead.machine->leader().waits().quantile_ms(0.5),
                lead.machine->leader().waits().quantile_ms(0.99),
                static_cast<std::uintmax_t>(lead.machine->leader().counts().incomplete));
    for (std::size_t i = 0; i < kNodes; ++i) {
        Told told;
        ASSERT_EQ(read(pipes[i][0], &told, sizeof(told)), static_cast<ssize_t>(sizeof(told)));
        waitpid(children[i], nullptr, 0);
        std::printf("a node showed %d of %d frames, %ju late; %ju repeats, %ju missed, %d wrong\n",
                    told.shown, kFrames, static_cast<std::uintmax_t>(told.late),
                    static_cast<std::uintmax_t>(told.repeats), static_cast<std::uintmax_t>(told.missed),
                    told.wrong);
        EXPECT_EQ(told.wrong, 0);
        EXPECT_EQ(told.backwards, 0);
        EXPECT_EQ(told.unreadable, 0U);
        EXPECT_GT(told.shown, kFrames / 2);
        EXPECT_EQ(static_cast<std::uint64_t>(told.shown) + told.repeats + told.missed,
                  static_cast<std::uint64_t>(kFrames));
    }
    // The guest has one processor for three machines, and shares that.
    EXPECT_GT(rate_hz, 10.0);
}

}  // namespace
}  // namespace skyig::tests
