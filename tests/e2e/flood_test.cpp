// What a flood on the wire does to the frames of three small channels, and what the counters say of it.
//   SKYIG_FLOOD_ROUNDS=N      N rounds of phases of four seconds, held to the bound (script/flood-check);
//   without
//                             it one short round whose times are told and not judged: who tests has other
//                             work too
//   SKYIG_FLOOD_DAEMON_CPU=A  the daemon keeps to processor A; without it the system puts it where it likes
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/e2e/flooder.h"
#include "tests/e2e/frame_times.h"
#include "tests/e2e/process.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

using Json = nlohmann::json;

constexpr double kBound = 0.05;
/// Frames of so long after a change of load belong to neither.
constexpr std::int64_t kSettle_ns = 100'000'000;
constexpr std::size_t kQuietParts = 3;

/// All frames of some phases.
struct Pool {
    std::vector<double> frame_us;
    std::vector<double> input_us;
    double seconds = 0.0;
    std::uint64_t host_sent = 0;
    std::uint64_t garbage_sent = 0;

    void add(const Phase& phase, const std::vector<FrameTime>& frames) {
        for (const FrameTime& frame : frames) {
            if (frame.utc_ns < phase.begin_utc_ns + kSettle_ns || frame.utc_ns >= phase.end_utc_ns) continue;
            frame_us.push_back(frame.frame_us);
            input_us.push_back(frame.input_us);
        }
        seconds += phase.seconds();
        host_sent += phase.host_sent;
        garbage_sent += phase.garbage_sent;
    }
    [[nodiscard]] double time_us(double q) const { return quantile(frame_us, q); }
};

void print(const std::string& name, const Pool& pool, const Pool& quiet) {
    const auto more_pct = [&](double q) { return 100.0 * (pool.time_us(q) / quiet.time_us(q) - 1.0); };
    std::printf(
        "%-17s %5zu frames: median %6.0f us (%+5.1f %%), p95 %6.0f us (%+5.1f %%), input %5.1f us; sent %.0f "
        "+ "
        "%.0f /s\n",
        name.c_str(), pool.frame_us.size(), pool.time_us(0.5), more_pct(0.5), pool.time_us(0.95),
        more_pct(0.95), quantile(pool.input_us, 0.5), static_cast<double>(pool.host_sent) / pool.seconds,
        static_cast<double>(pool.garbage_sent) / pool.seconds);
}

struct FloodSite : Site {
    FloodSite() {
        config_path = scratch.write("three.toml", "version = 1\n[daemon]\nrate_hz = 60\n[host]\nlisten = \"" +
                                                      listen() + "\"\nreply_to = \"" + reply() +
                                                      "\"\n[start]\nutc = \"2026-06-21T12:00:00Z\"\n" +
                                                      channel_toml("left", 160, 128, -60) +
                                                      channel_toml("centre", 160, 128, 0) +
                                                      channel_toml("right", 160, 128, 60));
    }
    std::string times_path = scratch.file("times.csv");
};

/// One run through all loads, each flood beside a quiet time.
struct FloodRun {
    FloodRun(int rounds, double phase_s) {
        std::optional<Pinned> pinned;
        const int sender_cpu = last_cpu();
        if (const auto cpu = number_from("SKYIG_FLOOD_DAEMON_CPU")) pinned.emplace(*cpu);
        Process daemon({SKYIGD_PROGRAM, "--config", site.config_path, "--headless", "--report",
                        site.report_path, "--times", site.times_path});
        pinned.reset();
        pinned.emplace(sender_cpu);
        EXPECT_TRUE(daemon.wait_for_err("ephemeris")) << daemon.err_so_far();
        Flooder flooder(site);
        const auto spend = [&](Load load, double seconds) { phases.push_back(flooder.run(load, seconds)); };
        const auto in_operation = [&] {
            return daemon.err_so_far().find("set mode operate") != std::string::npos;
        };
        for (int i = 0; i < 100 && !in_operation(); ++i)
            spend(Load::kQuiet, 0.2);
        EXPECT_TRUE(in_operation()) << daemon.err_so_far();
        first = phases.size();
        for (int round = 0; round < rounds; ++round) {
            for (const Load load :
                 {Load::kHostElsewhere, Load::kHostFlood, Load::kQuiet, Load::kGarbageElsewhere,
                  Load::kStrangerFlood, Load::kQuiet, Load::kNeighbourFlood, Load::kQuiet})
                spend(load, phase_s);
        }
        // What waits in queues is taken.
        spend(Load::kQuiet, 0.3);
        daemon.signal(SIGTERM);
        const Finished finished = daemon.wait();
        EXPECT_EQ(finished.status, 0) << finished.err;
        frames = read_frame_times(site.times_path);
        report = Json::parse(read_text(site.report_path));
    }

    FloodSite site;
    /// Those of the rounds begin at `first`; the last is not of them.
    std::vector<Phase> phases;
    std::size_t first = 0;
    std::vector<FrameTime> frames;
    Json report;
};

/// What was sent is found again, each datagram under the name of its fate.
void expect_all_counted(const FloodRun& run) {
    std::uint64_t host = 0;
    std::uint64_t neighbour = 0;
    std::uint64_t stranger = 0;
    std::uint64_t unheard = 0;
    for (const Phase& phase : run.phases) {
        host += phase.host_heard;
        if (phase.load == Load::kNeighbourFlood) {
            neighbour += phase.garbage_sent;
            unheard += phase.host_heard;
        }
        if (phase.load == Load::kStrangerFlood) stranger += phase.garbage_sent;
    }
    const Json& rejects = run.report.at("rejects");
    const auto datagrams = run.report.at("datagrams").get<std::uint64_t>();
    const auto not_allowed = rejects.at("not_allowed").get<std::uint64_t>();
    const auto too_many =
        rejects.at("queue_full").get<std::uint64_t>() + rejects.at("ring_full").get<std::uint64_t>();
    const auto ig_controls = run.report.at("packets").at("ig_control").get<std::uint64_t>();
    std::printf("sent: host %ju, neighbour %ju, stranger %ju\n", std::uintmax_t{host},
                std::uintmax_t{neighbour}, std::uintmax_t{stranger});
    std::printf("told: taken %ju (IG Control %ju), too many %ju, not allowed %ju\n",
                std::uintmax_t{datagrams}, std::uintmax_t{ig_controls}, std::uintmax_t{too_many},
                std::uintmax_t{not_allowed});
    // A daemon that had no processor in the end leaves what its queues hold.
    constexpr std::uint64_t kRoom = 20'000;
    EXPECT_LE(datagrams + not_allowed + too_many, host + neighbour + stranger);
    EXPECT_GE(datagrams + not_allowed + too_many + kRoom, host + neighbour + stranger);
    EXPECT_LE(not_allowed, stranger);
    EXPECT_GE(static_cast<double>(not_allowed + kRoom), 0.95 * static_cast<double>(stranger));
    // Only the neighbour's flood, which comes from the host's own address, can keep the host unheard for
    // long.
    EXPECT_GE(static_cast<double>(ig_controls + unheard), 0.9 * static_cast<double>(host));
}

TEST(Flood, IsCountedAndLeavesTheFramesAsQuick) {
    const std::optional<int> rounds = number_from("SKYIG_FLOOD_ROUNDS");
    const FloodRun run(rounds.value_or(1), rounds ? 4.0 : 0.4);
    expect_all_counted(run);
    std::array<Pool, kLoads> pools;
    std::array<Pool, kQuietParts> parts;
    std::size_t quiet_phases = 0;
    for (std::size_t i = run.first; i + 1 < run.phases.size(); ++i) {
        const Phase& phase = run.phases[i];
        pools[static_cast<std::size_t>(phase.load)].add(phase, run.frames);
        if (phase.load == Load::kQuiet) parts[quiet_phases++ % kQuietParts].add(phase, run.frames);
    }
    const Pool& quiet = pools[static_cast<std::size_t>(Load::kQuiet)];
    for (std::size_t i = 0; i < kLoads; ++i)
        print(to_text(static_cast<Load>(i)), pools[i], quiet);
    for (const Pool& part : parts)
        print("  of quiet", part, quiet);
    if (!rounds) return;
    for (const double q : {0.5, 0.95}) {
        const auto [low, high] = std::minmax({parts[0].time_us(q), parts[1].time_us(q), parts[2].time_us(q)});
        const double most = std::max(1.0 + kBound, high / low);
        std::printf("quantile %.2f: quiet differs from quiet by %.1f %%\n", q, 100.0 * (high / low - 1.0));
        for (const Load load : {Load::kHostFlood, Load::kStrangerFlood, Load::kNeighbourFlood})
            EXPECT_LE(pools[static_cast<std::size_t>(load)].time_us(q), most * quiet.time_us(q))
                << to_text(load) << ", quantile " << q;
    }
}

}  // namespace
}  // namespace skyig::tests
