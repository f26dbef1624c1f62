#include "server/rig/rig_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "config/rig.h"

namespace skyig::server::rig {

namespace {

using status::RigCount;
using status::RigNodeState;

static_assert(status::kMostRigNodes >= config::kMaxNodes);

RigNodeState state_of(const Member& member, std::uint64_t frame) noexcept {
    if (member.session == 0) return RigNodeState::kUnheard;
    if (!member.here) return RigNodeState::kLost;
    switch (member.state) {
        case NodeState::kRefuses:
            return RigNodeState::kRefused;
        case NodeState::kLeads:
            return RigNodeState::kLeads;
        case NodeState::kFollows:
            return member.drawn_frame < frame ? RigNodeState::kLate : RigNodeState::kReady;
        case NodeState::kJoins:
            break;
    }
    return RigNodeState::kJoins;
}

/// Without an allocation.
void tell_refusal(const Member& member, const Speaker& leader, status::RigNode& node) {
    std::array<char, 320> line{};
    const auto told =
        member.build != leader.build
            ? fmt::format_to_n(line.begin(), line.size(), "it is {}, the leader {}", member.build,
                               leader.build)
            : fmt::format_to_n(line.begin(), line.size(), "its settings are {:016x}, the leader's {:016x}",
                               member.settings, leader.settings);
    node.why.set({line.data(), std::min(told.size, line.size())});
}

void fill_node(const Member& member, const Leader& leader, std::uint64_t frame, std::int64_t now_ns,
               status::RigNode& node) {
    constexpr double kMsOfNs = 1e-6;
    node.name.set(member.name);
    node.state = state_of(member, frame);
    node.why.set({});
    if (node.state == RigNodeState::kRefused) tell_refusal(member, leader.settings().self, node);
    node.build.set(member.build);
    node.gl.set(member.gl);
    node.gl_errors = member.gl_errors;
    node.frame = member.drawn_frame;
    const bool draws = node.state == RigNodeState::kReady || node.state == RigNodeState::kLate;
    node.lag = draws && frame > member.drawn_frame ? frame - member.drawn_frame : 0;
    node.frame_ms = static_cast<double>(member.drawing_ns) * kMsOfNs;
    node.waited_ms = static_cast<double>(member.waited_ns) * kMsOfNs;
    node.repeats = member.repeats;
    node.late = member.late;
    node.left_out = member.left_out;
    node.losses = member.losses;
    node.silent_s = static_cast<double>(now_ns - member.heard_ns) * 1e-9;
}

void fill_counts(const Machine& machine, status::RigState& state) {
    const LeaderCounts& leader = machine.leader().counts();
    state[RigCount::kFrames] = leader.frames;
    state[RigCount::kBytes] = leader.bytes;
    state[RigCount::kIncomplete] = leader.incomplete;
    state[RigCount::kTooLarge] = leader.too_large;
    const FollowerCounts& follower = machine.follower().counts();
    state[RigCount::kRepeats] = follower.repeats;
    state[RigCount::kLate] = follower.late;
    state[RigCount::kMissed] = follower.missed;
    state[RigCount::kTakeovers] = machine.takeovers();
    state[RigCount::kLeaders] = follower.leaders;
    state[RigCount::kUnsealed] = leader.unsealed + follower.unsealed;
    state[RigCount::kStrangers] = leader.strangers + follower.strangers;
    state[RigCount::kUnreadable] = follower.unreadable;
    state[RigCount::kRefused] = follower.refused;
    state[RigCount::kOutranked] = follower.outranked;
    state[RigCount::kStale] = follower.stale;
    const LinkCounts link = machine.link_counts();
    state[RigCount::kSent] = link.sent;
    state[RigCount::kSendFailures] = link.send_failures;
    state[RigCount::kDeadlinesMissed] = link.deadlines_missed;
    state[RigCount::kSpeakersLost] = link.speakers_lost;
    state[RigCount::kOverwritten] = link.overwritten;
}

}  // namespace

void fill_status(const Machine& machine, std::uint64_t frame, status::RigState& state) {
    const Follower& follower = machine.follower();
    const Leader& leader = machine.leader();
    const bool leads = machine.leads();
    const bool follows = !leads && follower.has_leader() && !follower.leader_is_lost();
    state.role = leads     ? status::RigRole::kLeads
                 : follows ? status::RigRole::kFollows
                           : status::RigRole::kLooks;
    state.self.set(machine.name());
    state.leader.set({});
    if (leads) state.leader.set(machine.name());
    if (follows) state.leader.set(follower.leader());
    state.frame = frame;
    const TimeHistogram& waits = leader.waits();
    state.wait = {waits.count(), waits.quantile_ms(0.5), waits.quantile_ms(0.99), waits.largest_ms()};
    fill_counts(machine, state);
    state.node_count = 0;
    if (!leads) return;
    const std::int64_t now_ns = machine.clock().monotonic_ns();
    state.node_count = std::min(leader.members().size(), status::kMostRigNodes);
    for (std::size_t i = 0; i < state.node_count; ++i)
        fill_node(leader.members()[i], leader, frame, now_ns, state.nodes[i]);
}

}  // namespace skyig::server::rig
