// FlightGear's flight model on its way into the world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/canaerospace/bus_clock.h"
#include "protocol/flightgear/net_fdm.h"
#include "protocol/transport/datagram_ring.h"
#include "server/log.h"
#include "server/world/world.h"

namespace skyig::server {

/// Each packet is a place, an attitude and a velocity; between packets the place is carried on by the
/// velocity, counted from the packet's arrival. Its height above the sea is taken for that above the
/// ellipsoid, as the site's other heights are. Its clock counts whole seconds: ours runs on between them and
/// is slewed to it.
class FlightGearInput {
  public:
    FlightGearInput(std::size_t source, world::World& world, Log& log) noexcept
        : source_(source), world_(world), log_(log) {}

    void take(const protocol::transport::Datagram& datagram);

    [[nodiscard]] std::uint64_t packets() const noexcept { return packets_; }
    [[nodiscard]] std::uint64_t refused(protocol::flightgear::Reason reason) const noexcept {
        return refused_[static_cast<std::size_t>(reason)];
    }

  private:
    void report_time(std::int64_t unix_s, std::int64_t arrival_ns);

    std::size_t source_;
    world::World& world_;
    Log& log_;
    protocol::canaerospace::BusClock clock_;
    std::uint64_t packets_ = 0;
    std::array<std::uint64_t, protocol::flightgear::kReasons> refused_{};
};

}  // namespace skyig::server
