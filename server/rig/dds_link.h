// The Link on Eclipse Cyclone DDS: found by unicast on one named interface, nothing else.
//
// What each topic asks of the network, and why:
//   frame states  reliable: a frame that is lost is a map of clouds that differs from then on; the last
//                 kKeptStates are kept for who comes late or loses some, older ones nobody wants; a deadline
//                 of two periods and a liveliness lease, so that the carrier too sees a leader fall silent.
//   frame shows   reliable, the last one: a newer one says all that an older one does. Not kept for who comes
//                 late: it is of a frame that they have not drawn.
//   node states   reliable, the last of each node, kept for who comes late, so that a leader knows all nodes
//                 at once.
// Ownership stays shared. With exclusive ownership any program that gives its writer a larger strength mutes
// the leader, before anybody can look at its seal; here all is heard, seals are looked at first, and the rank
// that stands inside the sealed message decides which of two leaders is followed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "protocol/result.h"
#include "server/rig/link.h"

namespace skyig::server::rig {

struct DdsSettings {
    /// Of DDS, 0..230: ports follow from it. Rigs on one network each have one of their own.
    std::uint32_t domain = 0;
    /// Name of the one network interface that is used, "eth1", or its address.
    std::string interface;
    /// Addresses of the other machines; nobody else is asked.
    std::vector<std::string> peers;
    /// Of a frame.
    std::int64_t period_ns = 33'333'333;

    /// Else it neither tells frames nor hears of other nodes, so that their words go to those who may lead
    /// alone.
    bool may_lead = true;
    /// Programs of the rig on one machine that are looked for, at most.
    int most_programs = 4;

    static constexpr int kKeptStates = 8;
};

/// The text that Cyclone DDS is given in the place of its own settings: those of the environment have no say.
[[nodiscard]] std::string cyclone_settings(const DdsSettings& settings);

/// One at a time in a process and domain. The error is a line that says what is missing.
[[nodiscard]] protocol::Result<std::unique_ptr<Link>, std::string> open_dds_link(const DdsSettings& settings);

}  // namespace skyig::server::rig
