// Frames in step with a host that answers each Start of Frame: CIGI's synchronous operation.
#pragma once

#include <cstdint>

#include "config/pacing.h"
#include "server/clock.h"
#include "server/inbox.h"
#include "server/wire.h"
#include "server/world/world.h"

namespace skyig::server {

/// Holds a frame until the host in control has answered: until an IG Control has come that echoes this
/// frame's Start of Frame, or that of as many frames before as the settings allow. A host that echoes nothing
/// has answered when any message of it has come since. Only a host whose link is live is waited for, and no
/// longer than the settings say; the frame then goes on with what there is.
class LockStep {
  public:
    explicit LockStep(const config::Daemon& settings) noexcept : settings_(settings) {}

    /// Takes what has come, as often as it waits. Nothing with another pacing.
    void await(const Clock& clock, Wire& wire, Inbox& inbox, const world::World& world);

    /// Frames that went on without their answer.
    [[nodiscard]] std::uint64_t timeouts() const noexcept { return timeouts_; }

  private:
    [[nodiscard]] bool answered(const Inbox& inbox, const world::World& world) const noexcept;

    const config::Daemon& settings_;
    std::uint64_t timeouts_ = 0;
};

}  // namespace skyig::server
