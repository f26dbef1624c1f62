// A rig of several machines as the daemon has it: what stands in for pace, wire and painter of a machine
// alone.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "server/rig/frames.h"
#include "server/rig/link.h"
#include "server/rig/machine.h"

namespace skyig::server {

/// What of the daemon a rig works with; all must outlive it.
struct RigEnds {
    Clock& clock;
    Log& log;
    Pace& pace;
    /// Null where nobody is heard.
    Wire* wire;
    Painter& painter;
    world::World& world;
    /// \see rig::Machine::Idle
    rig::Machine::Idle idle;
    bool replays = false;
};

class RigPart {
  public:
    /// \param node  which of the settings' machines this is \param settings  their fingerprint
    /// \throws std::runtime_error with one line when key or network cannot be had
    RigPart(const config::Config& config, const std::string& node, std::uint64_t settings,
            const RigEnds& ends);

    [[nodiscard]] Pace& pace() noexcept { return pace_; }
    [[nodiscard]] Wire& wire() noexcept { return wire_; }
    [[nodiscard]] rig::RigPainter& painter() noexcept { return painter_; }
    [[nodiscard]] const rig::Machine& machine() const noexcept { return machine_; }

    /// Whether the machine may lead, so that it must hear the host.
    [[nodiscard]] static bool may_lead(const config::Rig& rig, const std::string& node);
    /// One line where settings and command line do not go together; empty where they do.
    [[nodiscard]] static std::string fault(const config::Config& config, const std::string& node,
                                           bool replays);

  private:
    rig::Key key_;
    rig::FrameCoder coder_;
    std::unique_ptr<rig::Link> link_;
    rig::Machine machine_;
    rig::RigPace pace_;
    rig::RigWire wire_;
    rig::RigPainter painter_;
};

}  // namespace skyig::server
