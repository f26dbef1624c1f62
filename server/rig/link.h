// The wire between the machines of a rig: three kinds of messages, to all others at once. One stands on
// Cyclone DDS; tests have one of their own.
#pragma once

#include <cstdint>

#include "server/rig/messages.h"

namespace skyig::server::rig {

/// What the network did, as far as the carrier can tell; since the start.
struct LinkCounts {
    std::uint64_t sent = 0;
    /// Not taken by the system, or too large.
    std::uint64_t send_failures = 0;
    /// Nothing came of a speaker for as long as a frame may take, by the carrier's own watch.
    std::uint64_t deadlines_missed = 0;
    /// Speakers that were there and are not.
    std::uint64_t speakers_lost = 0;
    /// Frames' states that the carrier had and that were overwritten before they were taken.
    std::uint64_t overwritten = 0;
};

/// Belongs to one thread. Own messages do not come back. Whatever comes was not looked at: seals and senses
/// are the caller's to check.
class Link {
  public:
    Link() = default;
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;
    Link(Link&&) = delete;
    Link& operator=(Link&&) = delete;
    virtual ~Link() = default;

    virtual void send(const FrameMessage& message) = 0;
    virtual void send(const ShowMessage& message) = 0;
    virtual void send(const NodeMessage& message) = 0;

    /// The oldest that has come of its kind. \return false where there is none
    [[nodiscard]] virtual bool take(FrameMessage& message) = 0;
    [[nodiscard]] virtual bool take(ShowMessage& message) = 0;
    [[nodiscard]] virtual bool take(NodeMessage& message) = 0;

    /// Returns once something may be taken, and after `most_ns` at most.
    virtual void wait(std::int64_t most_ns) = 0;

    [[nodiscard]] virtual LinkCounts counts() const = 0;
};

}  // namespace skyig::server::rig
