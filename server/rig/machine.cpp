#include "server/rig/machine.h"

#include <algorithm>
#include <utility>

namespace skyig::server::rig {

namespace {

constexpr std::int64_t kAliveEvery_ns = Follower::kAliveEvery_ns;

std::uint32_t rank_of(const MachineSettings& settings) {
    const auto& may = settings.leaders;
    return static_cast<std::uint32_t>(may.end() - std::find(may.begin(), may.end(), settings.self.node));
}

std::vector<std::string> others(const MachineSettings& settings) {
    std::vector<std::string> names = settings.nodes;
    std::erase(names, settings.self.node);
    return names;
}

}  // namespace

Machine::Machine(MachineSettings settings, const Key& key, const FrameCoder& coder, Link& link,
                 const Clock& clock, Log& log)
    : settings_(std::move(settings)),
      link_(link),
      clock_(clock),
      log_(log),
      rank_(rank_of(settings_)),
      follower_({settings_.self, settings_.leaders, settings_.lost_after_ns}, key, coder, link, clock, log),
      leader_({.self = settings_.self,
               .rank = rank_,
               .nodes = others(settings_),
               .wait_ns = settings_.replays ? settings_.replay_wait_ns : settings_.wait_ns,
               // However long a node of a replay takes, nobody waits for its display.
               .lost_after_ns = settings_.replays ? settings_.replay_wait_ns : settings_.node_lost_after_ns,
               .waits_for_all = settings_.replays},
              key, coder, link, clock, log),
      began_ns_(clock.monotonic_ns()) {}

bool Machine::should_lead() const noexcept {
    if (!may_lead()) return false;
    if (settings_.replays) return true;
    const std::size_t place = settings_.leaders.size() - rank_;
    if (follower_.has_leader()) {
        const auto patience = static_cast<std::int64_t>(place > 0 ? place - 1 : 0);
        return follower_.silent_ns() > settings_.lost_after_ns + patience * settings_.lost_after_ns / 2;
    }
    const std::int64_t listens_ns =
        place == 0 ? settings_.leader_listens_ns
                   : settings_.stand_in_listens_ns +
                         static_cast<std::int64_t>(place - 1) * settings_.lost_after_ns / 2;
    return clock_.monotonic_ns() - began_ns_ > listens_ns;
}

bool Machine::lead(const Idle& idle) {
    if (follower_.has_leader())
        log_.warning("{} is silent since frame {}: {} leads from here on", follower_.leader(),
                     follower_.last_frame(), name());
    else
        log_.notice("{} leads", name());
    leads_ = true;
    ++takeovers_;
    follower_.forget_leader();
    follower_.hear_above(rank_);
    if (!settings_.replays) return true;
    const std::int64_t end_ns = clock_.monotonic_ns() + settings_.replay_waits_for_nodes_ns;
    leader_.listen();
    while (!leader_.all_here() && clock_.monotonic_ns() < end_ns) {
        if (!idle()) return false;
        link_.wait(kAliveEvery_ns);
        leader_.listen();
    }
    if (!leader_.all_here()) log_.warning("not all nodes are there: the replay begins without them");
    return true;
}

/// Two lead after a cable was cut: the weaker one gives in.
void Machine::look_for_a_stronger_leader() {
    follower_.listen();
    if (follower_.waiting() == 0) return;
    log_.warning("{} leads too, and comes first: {} follows it", follower_.leader(), name());
    leads_ = false;
    follower_.hear_above(0);
}

Follower::Word Machine::await_word(std::uint64_t frame, const Idle& idle) {
    return follower_.await_word(frame, may_lead() ? settings_.lost_after_ns : settings_.patience_ns, idle);
}

bool Machine::await_work(const Idle& idle) {
    if (leads_ && !settings_.replays) look_for_a_stronger_leader();
    if (leads_) return true;
    std::int64_t said_ns = 0;
    for (;;) {
        follower_.listen();
        if (follower_.waiting() > 0) return true;
        if (should_lead()) return lead(idle);
        if (!idle()) return false;
        const std::int64_t now_ns = clock_.monotonic_ns();
        if (said_ns == 0 || now_ns - said_ns >= kAliveEvery_ns) {
            said_ns = now_ns;
            follower_.tell_alive();
        }
        link_.wait(kAliveEvery_ns);
    }
}

}  // namespace skyig::server::rig
