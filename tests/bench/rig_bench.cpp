// What the lock of a rig costs by its number of nodes: a leader and nodes that draw nothing, each a program
// of its own on this machine, over Cyclone DDS on the loopback.
//   rig_bench [FRAMES]    frames of each rig at 30 Hz (150)
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "server/pace.h"
#include "tests/support/rig_program.h"

namespace {

using namespace skyig::server;

using skyig::tests::RigProgram;
constexpr double kRate_hz = RigProgram::kRate_hz;

/// Follows until it is killed.
[[noreturn]] void run_node(int node, int nodes, int domain) {
    RigProgram program(node, nodes, domain);
    if (!program.machine) std::_Exit(1);
    for (;;) {
        if (!program.machine->await_work([] { return true; })) std::_Exit(0);
        rig::Follower& follower = program.machine->follower();
        const std::uint64_t frame = follower.newest().scene.frame_number;
        follower.clear();
        follower.tell_drawn(frame, 0);
        (void)program.machine->await_word(frame, [] { return true; });
    }
}

void run_leader(int nodes, int domain, int frames) {
    RigProgram program(0, nodes, domain);
    if (!program.machine) {
        fmt::print("{}\n", program.link.error());
        return;
    }
    rig::Leader& leader = program.machine->leader();
    (void)program.await_nodes(20.0);
    ClockPace pace(program.clock, kRate_hz);
    rig::FrameState state;
    state.scene.weather.cloud_count = 3;
    state.scene.view_count = 3;
    TimeHistogram waits;
    TimeHistogram telling;
    const int warm = 30;
    for (int i = 0; i < frames + warm; ++i) {
        (void)pace.next();
        state.scene.frame_number = static_cast<std::uint64_t>(i) + 1;
        state.scene.time_s = i / kRate_hz;
        const std::int64_t start_ns = program.clock.monotonic_ns();
        leader.tell(state);
        const std::int64_t told_ns = program.clock.monotonic_ns() - start_ns;
        const std::int64_t waited_ns = leader.await(state.scene.frame_number);
        leader.tell_show(state.scene.frame_number);
        if (i < warm) continue;
        telling.add(told_ns);
        waits.add(waited_ns);
    }
    fmt::print("{:5} {:12.2f} {:8.2f} {:8.2f} {:8.2f} {:11}\n", nodes, telling.quantile_ms(0.5),
               waits.quantile_ms(0.5), waits.quantile_ms(0.99), waits.largest_ms(),
               leader.counts().incomplete);
}

}  // namespace

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 150;
    fmt::print("ms at {:g} Hz; a frame that is incomplete was shown without some node\n", kRate_hz);
    fmt::print("nodes  telling p50 wait p50      p99  largest  incomplete\n");
    int domain = 150;
    for (const int nodes : {1, 2, 4, 8, 16}) {
        std::fflush(stdout);
        ++domain;
        std::vector<pid_t> children;
        for (int i = 1; i <= nodes; ++i) {
            const pid_t child = fork();
            if (child == 0) run_node(i, nodes, domain);
            children.push_back(child);
        }
        // DDS once a process.
        const pid_t leader = fork();
        if (leader == 0) {
            run_leader(nodes, domain, frames);
            std::fflush(stdout);
            std::_Exit(0);
        }
        waitpid(leader, nullptr, 0);
        for (const pid_t child : children) {
            kill(child, SIGKILL);
            waitpid(child, nullptr, 0);
        }
    }
    return 0;
}
