// Datagrams on their way into the world: decoded and counted, and what is wrong with them told at a limited
// rate.
#pragma once

#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/counters.h"
#include "server/arrivals.h"
#include "server/bus_input.h"
#include "server/flightgear_input.h"
#include "server/host_timing.h"
#include "server/log.h"
#include "server/report.h"
#include "server/wire.h"
#include "server/world/world.h"

namespace skyig::server {

class Inbox final : public ArrivalTaker {
  public:
    /// \throws std::runtime_error with one line when a bus's identifiers cannot be used
    Inbox(const config::Config& config, world::World& world, Log& log);

    /// Another frame takes what comes from here on.
    void begin_frame() noexcept { frame_arrivals_.clear(); }
    void take(std::size_t source, const protocol::transport::Datagram& datagram) override;
    void take(std::size_t source, const protocol::CanFrame& frame) override;

    [[nodiscard]] const protocol::cigi::Counters& counters() const noexcept { return counters_; }
    [[nodiscard]] const FramesBehind& frames_behind() const noexcept { return frames_behind_; }
    /// What the frame at hand has taken.
    [[nodiscard]] const Arrivals& frame_arrivals() const noexcept { return frame_arrivals_; }
    [[nodiscard]] const HostTiming& host_timing() const noexcept { return host_timing_; }
    /// The frame number that the host in control has echoed last; 0: none.
    [[nodiscard]] std::uint32_t last_echo() const noexcept { return last_echo_; }
    /// The bus of a source, or null.
    [[nodiscard]] const BusInput* bus(std::size_t source) const noexcept { return buses_[source].get(); }
    /// The flight model of a source, or null.
    [[nodiscard]] const FlightGearInput* flight_model(std::size_t source) const noexcept {
        return flight_models_[source].get();
    }
    /// Datagrams or CAN frames that a source has sent.
    [[nodiscard]] std::uint64_t arrivals(std::size_t source) const noexcept { return arrivals_[source]; }
    [[nodiscard]] std::uint64_t datagrams() const noexcept { return datagrams_; }
    /// Datagrams and CAN frames.
    [[nodiscard]] std::uint64_t arrivals() const noexcept {
        return std::accumulate(arrivals_.begin(), arrivals_.end(), std::uint64_t{0});
    }

  private:
    class Handler;

    void take_message(std::size_t source, const protocol::transport::Datagram& datagram);

    world::World& world_;
    Log& log_;
    protocol::cigi::Counters counters_;
    FramesBehind frames_behind_;
    Arrivals frame_arrivals_;
    HostTiming host_timing_;
    std::uint32_t last_echo_ = 0;
    std::uint64_t datagrams_ = 0;
    std::vector<std::uint64_t> arrivals_;
    /// By source; null where it speaks something else.
    std::vector<std::unique_ptr<BusInput>> buses_;
    std::vector<std::unique_ptr<FlightGearInput>> flight_models_;
};

}  // namespace skyig::server
