// This machine's part in a rig: whether it leads or follows, and when that changes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/clock.h"
#include "server/log.h"
#include "server/rig/follower.h"
#include "server/rig/leader.h"

namespace skyig::server::rig {

struct MachineSettings {
    Speaker self;
    /// Who may lead, the leader first, then its stand-ins in their order.
    std::vector<std::string> leaders;
    /// All machines, this one too.
    std::vector<std::string> nodes;
    std::int64_t wait_ns = 10'000'000;
    /// A replay: nobody waits for its frames, so they wait for all nodes, and it leads at once.
    bool replays = false;

    /// A leader that comes listens for so long whether another one stands in for it; so does a stand-in, for
    /// its leader.
    std::int64_t leader_listens_ns = 1'000'000'000;
    std::int64_t stand_in_listens_ns = 4'000'000'000;
    /// A leader that is silent for so long is lost; each further stand-in gives the one before it half as
    /// long again.
    std::int64_t lost_after_ns = 500'000'000;
    /// The same of a node, which is then waited for no more.
    std::int64_t node_lost_after_ns = 1'000'000'000;
    /// Who can do nothing about it waits so long for its word on a frame that is drawn.
    std::int64_t patience_ns = 10'000'000'000;
    /// Of a replay: for nodes that are not there, and for one that is to draw a frame.
    std::int64_t replay_waits_for_nodes_ns = 60'000'000'000;
    std::int64_t replay_wait_ns = 10'000'000'000;
};

class Machine {
  public:
    using Idle = Follower::Idle;

    /// All must outlive it.
    Machine(MachineSettings settings, const Key& key, const FrameCoder& coder, Link& link, const Clock& clock,
            Log& log);

    /// Waits until this machine leads, or has frames to draw. \return false when it was told to give up
    [[nodiscard]] bool await_work(const Idle& idle);

    /// \see Follower::await_word(); who may take over gives up on a leader that is lost
    [[nodiscard]] Follower::Word await_word(std::uint64_t frame, const Idle& idle);

    [[nodiscard]] bool leads() const noexcept { return leads_; }
    [[nodiscard]] bool may_lead() const noexcept { return rank_ > 0; }
    /// How often it has become the leader.
    [[nodiscard]] std::uint64_t takeovers() const noexcept { return takeovers_; }
    [[nodiscard]] Follower& follower() noexcept { return follower_; }
    [[nodiscard]] const Follower& follower() const noexcept { return follower_; }
    [[nodiscard]] Leader& leader() noexcept { return leader_; }
    [[nodiscard]] const Leader& leader() const noexcept { return leader_; }
    [[nodiscard]] const std::string& name() const noexcept { return settings_.self.node; }
    [[nodiscard]] LinkCounts link_counts() const { return link_.counts(); }
    [[nodiscard]] const Clock& clock() const noexcept { return clock_; }

  private:
    [[nodiscard]] bool should_lead() const noexcept;
    [[nodiscard]] bool lead(const Idle& idle);
    void look_for_a_stronger_leader();

    MachineSettings settings_;
    Link& link_;
    const Clock& clock_;
    Log& log_;
    /// 0: may not lead.
    std::uint32_t rank_;
    Follower follower_;
    Leader leader_;
    bool leads_ = false;
    std::int64_t began_ns_;
    std::uint64_t takeovers_ = 0;
};

}  // namespace skyig::server::rig
