// A machine of a rig as a program that draws nothing, over Cyclone DDS on this machine's loopback: for what
// the network does, not for pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/clock.h"
#include "server/log.h"
#include "server/rig/dds_link.h"
#include "server/rig/machine.h"

namespace skyig::tests {

/// "node-0" leads. One in a process and domain.
struct RigProgram {
    static constexpr double kRate_hz = 30.0;
    static constexpr server::rig::Key kKey{1, 2};

    RigProgram(int node, int nodes, int domain)
        : log(clock, [](server::Severity, std::string_view) {}),
          link(server::rig::open_dds_link({.domain = static_cast<std::uint32_t>(domain),
                                           .interface = "lo",
                                           .peers = {"127.0.0.1"},
                                           .period_ns = static_cast<std::int64_t>(1e9 / kRate_hz),
                                           .may_lead = node == 0,
                                           .most_programs = 40})) {
        if (!link) return;
        server::rig::MachineSettings settings{
            .self = {name_of(node), static_cast<std::uint64_t>(clock.utc_ns()), "test", 1},
            .leaders = {name_of(0)},
            .nodes = {},
            .wait_ns = 20'000'000};
        for (int i = 0; i <= nodes; ++i)
            settings.nodes.push_back(name_of(i));
        machine = std::make_unique<server::rig::Machine>(settings, kKey, coder, **link, clock, log);
    }

    static std::string name_of(int node) { return "node-" + std::to_string(node); }

    /// Of the leader: until all are there, no longer than that.
    bool await_nodes(double most_s) {
        server::rig::Leader& leader = machine->leader();
        (void)machine->await_work([] { return true; });
        const std::int64_t end_ns = clock.monotonic_ns() + static_cast<std::int64_t>(most_s * 1e9);
        for (leader.listen(); !leader.all_here() && clock.monotonic_ns() < end_ns; leader.listen())
            (**link).wait(10'000'000);
        return leader.all_here();
    }

    server::SystemClock clock;
    server::Log log;
    server::rig::FrameCoder coder;
    protocol::Result<std::unique_ptr<server::rig::Link>, std::string> link;
    /// Null where there is no network; link.error() says why.
    std::unique_ptr<server::rig::Machine> machine;
};

}  // namespace skyig::tests
