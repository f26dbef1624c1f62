// Datagrams on their way into the world: decoded and counted, and what is wrong with them told at a limited
// rate.
#pragma once

#include <cstdint>

#include "protocol/cigi/counters.h"
#include "server/host_link.h"
#include "server/log.h"
#include "server/report.h"
#include "server/world/world.h"

namespace skyig::server {

class Inbox final : public DatagramTaker {
  public:
    Inbox(world::World& world, Log& log) noexcept : world_(world), log_(log) {}

    void take(const protocol::transport::Datagram& datagram) override;

    [[nodiscard]] const protocol::cigi::Counters& counters() const noexcept { return counters_; }
    [[nodiscard]] const FramesBehind& frames_behind() const noexcept { return frames_behind_; }
    [[nodiscard]] std::uint64_t datagrams() const noexcept { return datagrams_; }

  private:
    class Handler;

    world::World& world_;
    Log& log_;
    protocol::cigi::Counters counters_;
    FramesBehind frames_behind_;
    std::uint64_t datagrams_ = 0;
};

}  // namespace skyig::server
