// What the lock of a rig costs by its number of nodes: a leader and nodes that draw nothing, each a program
// of its own on this machine, over Cyclone DDS on the loopback. Prints Markdown, as docs/rig.md has it.
//   rig_bench [FRAMES]    frames of each rig at 30 Hz (150); one run at a time on a machine
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "server/pace.h"
#include "tests/support/rig_program.h"

namespace {

using namespace skyig::server;

using skyig::tests::RigProgram;
constexpr double kRate_hz = RigProgram::kRate_hz;

/// What one size of rig took, milliseconds.
struct Row {
    int nodes = 0;
    double telling_ms = 0.0;
    double wait_ms = 0.0;
    double wait_p99_ms = 0.0;
    double wait_largest_ms = 0.0;
    std::uint64_t incomplete = 0;
    std::uint64_t state_bytes = 0;
};

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

/// Three layers and three channels, every number of them with a full mantissa.
std::unique_ptr<rig::FrameState> usual_state() {
    auto state = std::make_unique<rig::FrameState>();
    auto& scene = state->scene;
    scene.eye = {47.0 + 1.0 / 3.0, 8.0 + 2.0 / 3.0, 4321.0 / 7.0};
    scene.weather.cloud_count = 3;
    for (auto& layer : scene.weather.clouds) {
        if (&layer == &scene.weather.clouds[3]) break;
        layer.base_m = 4321.0 / 3.0;
        layer.thickness_m = 4321.0 / 7.0;
        layer.coverage = 1.0 / 3.0;
        layer.age_s = 1e4 / 3.0;
        layer.drift_m = {1e5 / 3.0, 1e5 / 7.0};
    }
    scene.view_count = 3;
    for (std::size_t i = 0; i < scene.view_count; ++i)
        scene.views[i].view_from_enu = glm::dmat3{1.0 / 3.0, 1.0 / 7.0, 1.0 / 9.0,  1.0 / 11.0, 1.0 / 13.0,
                                                  1.0 / 17., 1.0 / 19., 1.0 / 21.0, 1.0 / 23.0};
    return state;
}

/// \return of no nodes where the network cannot be had
Row run_leader(int nodes, int domain, int frames) {
    RigProgram program(0, nodes, domain);
    if (!program.machine) {
        fmt::print(stderr, "{}\n", program.link.error());
        return {};
    }
    rig::Leader& leader = program.machine->leader();
    if (!program.await_nodes(20.0)) {
        fmt::print(stderr, "not all {} nodes came within 20 s\n", nodes);
        return {};
    }
    ClockPace pace(program.clock, kRate_hz);
    const auto state = usual_state();
    TimeHistogram waits;
    TimeHistogram telling;
    const int warm = 30;
    std::uint64_t incomplete_before = 0;
    for (int i = 0; i < frames + warm; ++i) {
        (void)pace.next();
        if (i == warm) incomplete_before = leader.counts().incomplete;
        state->scene.frame_number = static_cast<std::uint64_t>(i) + 1;
        state->scene.time_s = i / kRate_hz;
        const std::int64_t start_ns = program.clock.monotonic_ns();
        leader.tell(*state);
        const std::int64_t told_ns = program.clock.monotonic_ns() - start_ns;
        const std::int64_t waited_ns = leader.await(state->scene.frame_number);
        leader.tell_show(state->scene.frame_number);
        if (i < warm) continue;
        telling.add(told_ns);
        waits.add(waited_ns);
    }
    return {nodes,
            telling.quantile_ms(0.5),
            waits.quantile_ms(0.5),
            waits.quantile_ms(0.99),
            waits.largest_ms(),
            leader.counts().incomplete - incomplete_before,
            leader.counts().bytes / leader.counts().frames};
}

/// The leader and its nodes in programs of their own: DDS once a process.
Row run_rig(int nodes, int domain, int frames) {
    std::vector<pid_t> children;
    for (int i = 1; i <= nodes; ++i) {
        const pid_t child = fork();
        if (child == 0) run_node(i, nodes, domain);
        children.push_back(child);
    }
    int ends[2] = {};
    Row row;
    if (pipe(ends) != 0) std::exit(1);
    const pid_t leader = fork();
    if (leader == 0) {
        row = run_leader(nodes, domain, frames);
        std::_Exit(write(ends[1], &row, sizeof(row)) == sizeof(row) ? 0 : 1);
    }
    close(ends[1]);
    if (read(ends[0], &row, sizeof(row)) != sizeof(row)) row = {};
    close(ends[0]);
    waitpid(leader, nullptr, 0);
    for (const pid_t child : children) {
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
    }
    return row;
}

/// On paper: so many nodes, each a machine of its own, round one switch.
void print_estimate(const Row& few, const Row& most, int nodes) {
    // Beside a message's own bytes: Ethernet with preamble and gap, IP, UDP, RTPS, names and tag, and its
    // share of heartbeats and their answers.
    constexpr double kRoundBytes = 300.0;
    constexpr double kWordBytes = 150.0;
    constexpr double kShowBytes = 50.0;
    constexpr double kBitsPerMs = 1e6;
    // Together: where nodes share the leader's processors, what one takes the other lacks.
    const double few_ms = few.telling_ms + few.wait_ms;
    const double growth_ms = (most.telling_ms + most.wait_ms - few_ms) / (most.nodes - few.nodes);
    const auto wire_ms = [nodes](double bytes) { return 8.0 * nodes * (bytes + kRoundBytes) / kBitsPerMs; };
    const auto state_bytes = static_cast<double>(few.state_bytes);
    fmt::print(
        "\nOn paper, {} nodes on 1 GbE at {:g} Hz: telling and waiting {:.1f} ms by their growth above, "
        "where all "
        "nodes share the processors of one machine; {:.0f} bytes of state to each hold the wire for {:.1f} "
        "ms, the "
        "word of each for {:.1f} ms, \"show\" for {:.1f} ms.\n",
        nodes, kRate_hz, few_ms + growth_ms * (nodes - few.nodes), state_bytes, wire_ms(state_bytes),
        wire_ms(kWordBytes), wire_ms(kShowBytes));
}

}  // namespace

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 150;
    fmt::print(
        "| nodes | telling, median ms | wait for all, median ms | p99 ms | largest ms | frames shown without "
        "a node |\n"
        "|---|---|---|---|---|---|\n");
    std::vector<Row> rows;
    for (const int nodes : {1, 2, 4, 8, 16}) {
        std::fflush(stdout);
        const Row row = run_rig(nodes, 150 + nodes, frames);
        if (row.nodes == 0) return 1;
        fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} |\n", row.nodes, row.telling_ms,
                   row.wait_ms, row.wait_p99_ms, row.wait_largest_ms, row.incomplete);
        rows.push_back(row);
    }
    print_estimate(rows.front(), rows.back(), 64);
    return 0;
}
