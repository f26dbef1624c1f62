// A machine's ear for its leader: which of those that say so leads, what it says to draw, and when to show
// it. Knows neither sockets nor pictures.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "server/clock.h"
#include "server/log.h"
#include "server/rig/frame_coder.h"
#include "server/rig/frame_state.h"
#include "server/rig/link.h"
#include "server/rig/tag.h"

namespace skyig::server::rig {

struct FollowerSettings {
    Speaker self;
    /// Who may lead.
    std::vector<std::string> leaders;
    /// Silent for so long, a leader is lost; for half of it, another one is heard.
    std::int64_t lost_after_ns = 500'000'000;
};

/// What came that was not obeyed, and what was not shown; since the start.
struct FollowerCounts {
    std::uint64_t unsealed = 0;    ///< by another key, or by none
    std::uint64_t strangers = 0;   ///< of machines that may not lead
    std::uint64_t unreadable = 0;  ///< states that are none
    std::uint64_t refused = 0;     ///< of another build, or with other settings
    std::uint64_t outranked = 0;   ///< of a second leader
    std::uint64_t stale = 0;       ///< of frames that are over, and of runs of a leader that are
    std::uint64_t missed = 0;      ///< frames that never came
    std::uint64_t repeats = 0;     ///< the leader had gone on: the picture before stayed
    std::uint64_t late = 0;        ///< shown, but after the leader's word
    std::uint64_t leaders = 0;     ///< followed one after the other
};

class Follower {
  public:
    /// Frames that wait to be drawn; where more come the oldest are missed.
    static constexpr std::size_t kMostWaiting = 16;

    /// All must outlive it.
    Follower(FollowerSettings settings, const Key& key, const FrameCoder& coder, Link& link,
             const Clock& clock, Log& log);

    /// Takes what leaders have said.
    void listen();

    /// Frames that are to be drawn, oldest first. Each is to be prepared, since what is shared of a frame
    /// goes on from the frame before; only the newest is worth drawing.
    [[nodiscard]] std::size_t waiting() const noexcept { return waiting_; }
    [[nodiscard]] const FrameState& frame(std::size_t index) const noexcept {
        return frames_[(first_ + index) % kMostWaiting];
    }
    [[nodiscard]] const FrameState& newest() const noexcept { return frame(waiting_ - 1); }
    /// They have been prepared; in the place of all but the newest the picture before stayed.
    void clear() noexcept {
        if (draws_ && waiting_ > 1) counts_.repeats += waiting_ - 1;
        waiting_ = 0;
    }

    /// Says that a frame's pixels are finished.
    void tell_drawn(std::uint64_t frame, std::int64_t drawing_ns);
    /// Says that it is there: once in a while when no frame comes.
    void tell_alive();
    /// Of this machine, for who asks: kept for the messages to come.
    void note_gl(const std::string& description, std::uint64_t errors);

    /// Called now and then while nothing is to be done. \return false to give up
    using Idle = std::function<bool()>;
    enum class Word : std::uint8_t {
        kShow,    ///< now
        kLate,    ///< the others show it already
        kRepeat,  ///< they are further: what was shown stays
    };
    /// After tell_drawn(): waits for the leader's word until it has been silent for so long, or `idle` says
    /// to give up.
    [[nodiscard]] Word await_word(std::uint64_t frame, std::int64_t patience_ns, const Idle& idle);
    /// Between two words that a machine is there.
    static constexpr std::int64_t kAliveEvery_ns = 100'000'000;

    /// Since the leader was heard, or since the start when none was.
    [[nodiscard]] std::int64_t silent_ns() const noexcept { return clock_.monotonic_ns() - heard_ns_; }
    [[nodiscard]] bool has_leader() const noexcept { return !leader_.node.empty(); }
    [[nodiscard]] bool leader_is_lost() const noexcept { return silent_ns() > settings_.lost_after_ns; }
    /// Empty before the first.
    [[nodiscard]] const std::string& leader() const noexcept { return leader_.node; }
    [[nodiscard]] std::uint32_t leader_rank() const noexcept { return leader_rank_; }
    [[nodiscard]] std::uint64_t last_frame() const noexcept { return last_frame_; }
    [[nodiscard]] const FollowerCounts& counts() const noexcept { return counts_; }
    [[nodiscard]] const FollowerSettings& settings() const noexcept { return settings_; }

    /// Whom this machine outranks while it leads itself: weaker leaders are not heard.
    void hear_above(std::uint32_t rank) noexcept { least_rank_ = rank; }
    /// Forgets its leader, to be one.
    void forget_leader() noexcept;

  private:
    void take(const FrameMessage& message);
    [[nodiscard]] bool obeys(const FrameMessage& message);
    [[nodiscard]] bool is_news(const FrameMessage& message);
    void follow(const FrameMessage& message);
    void say(NodeState state);

    FollowerSettings settings_;
    const Key& key_;
    const FrameCoder& coder_;
    Link& link_;
    const Clock& clock_;
    Log& log_;

    Speaker leader_;
    std::uint32_t leader_rank_ = 0;
    /// How far each of settings_.leaders was heard: what it once said counts once, whoever sends it again.
    struct Heard {
        std::uint64_t session = 0;
        std::uint64_t frame = 0;
    };
    std::vector<Heard> heard_;
    std::uint32_t least_rank_ = 0;
    std::int64_t heard_ns_;
    bool any_frame_ = false;
    std::uint64_t last_frame_ = 0;
    /// Up to which the leader has said to show, or has gone on from.
    std::uint64_t told_frame_ = 0;
    bool refuses_ = false;
    bool draws_ = false;

    std::vector<FrameState> frames_;
    std::size_t first_ = 0;
    std::size_t waiting_ = 0;

    FrameMessage frame_message_;
    ShowMessage show_message_;
    NodeMessage node_message_;
    NodeMessage own_;
    FollowerCounts counts_;
};

}  // namespace skyig::server::rig
