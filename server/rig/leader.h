// A machine's voice as the leader of a rig: says what to draw, waits until all nodes have drawn it, and says
// when to show it. Knows neither sockets nor pictures.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "server/clock.h"
#include "server/log.h"
#include "server/rig/frame_coder.h"
#include "server/rig/frame_state.h"
#include "server/rig/link.h"
#include "server/rig/tag.h"
#include "server/time_histogram.h"

namespace skyig::server::rig {

struct LeaderSettings {
    Speaker self;
    /// Of two leaders the one with the larger leads.
    std::uint32_t rank = 1;
    /// All other machines of the rig.
    std::vector<std::string> nodes;
    /// A frame waits no longer than that for nodes that have not drawn it, from when the leader has.
    std::int64_t wait_ns = 10'000'000;
    /// Not heard of for so long, a node is lost and waited for no more.
    std::int64_t lost_after_ns = 1'000'000'000;
    /// Nodes that have yet to draw their first frame are waited for too: for runs that nobody waits for.
    bool waits_for_all = false;
};

/// A node as its leader knows it.
struct Member {
    std::string name;
    bool here = false;
    NodeState state = NodeState::kJoins;
    std::string build;
    std::uint64_t settings = 0;
    std::string gl;
    std::uint64_t gl_errors = 0;
    std::uint64_t drawn_frame = 0;
    std::int64_t drawing_ns = 0;
    /// From the leader's own pixels to word of the node's, of the last frame.
    std::int64_t waited_ns = 0;
    /// By the node's own count.
    std::uint64_t repeats = 0;
    std::uint64_t late = 0;
    /// Frames that were shown without it.
    std::uint64_t left_out = 0;
    /// How often it fell silent.
    std::uint64_t losses = 0;
    std::int64_t heard_ns = 0;
    std::uint64_t session = 0;
};

struct LeaderCounts {
    std::uint64_t frames = 0;
    /// Frames that were shown before all nodes had drawn them.
    std::uint64_t incomplete = 0;
    /// Scenes that are too large to travel, or hold a picture that is not known everywhere: the nodes kept
    /// the picture before.
    std::uint64_t too_large = 0;
    std::uint64_t unsealed = 0;
    std::uint64_t strangers = 0;
    std::uint64_t bytes = 0;
};

class Leader {
  public:
    /// All must outlive it.
    Leader(LeaderSettings settings, const Key& key, const FrameCoder& coder, Link& link, const Clock& clock,
           Log& log);

    /// Takes what nodes have said.
    void listen();
    /// Whether all nodes are there.
    [[nodiscard]] bool all_here() const noexcept;

    /// Says what to draw, by its scene's frame number.
    void tell(const FrameState& state);
    /// Returns when all nodes that are there have drawn the frame, or the wait is over. \return how long that
    /// took, nanoseconds
    std::int64_t await(std::uint64_t frame);
    /// Says to show it.
    void tell_show(std::uint64_t frame);

    [[nodiscard]] std::span<const Member> members() const noexcept { return members_; }
    [[nodiscard]] const LeaderCounts& counts() const noexcept { return counts_; }
    /// Of await().
    [[nodiscard]] const TimeHistogram& waits() const noexcept { return waits_; }
    [[nodiscard]] const LeaderSettings& settings() const noexcept { return settings_; }

  private:
    void take(const NodeMessage& message);
    void refuse(Member& member);
    [[nodiscard]] bool is_awaited(const Member& member, std::uint64_t frame) const noexcept;
    void miss_silent_ones();

    LeaderSettings settings_;
    const Key& key_;
    const FrameCoder& coder_;
    Link& link_;
    const Clock& clock_;
    Log& log_;
    std::vector<Member> members_;
    /// When the leader's own pixels of the frame were finished.
    std::int64_t finished_ns_ = 0;
    std::uint64_t finished_frame_ = 0;
    FrameMessage frame_message_;
    ShowMessage show_message_;
    NodeMessage node_message_;
    LeaderCounts counts_;
    TimeHistogram waits_;
};

}  // namespace skyig::server::rig
