// A host's side of the CIGI link without socket or clock: what it says next, given what the image generator
// answered.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "clients/skyig/flight.h"
#include "protocol/cigi/message.h"
#include "protocol/cigi/packets.h"
#include "protocol/cigi/wire.h"
#include "server/ephemeris/time.h"

namespace skyig::clients {

struct HostSettings {
    protocol::cigi::Version version = protocol::cigi::Version::k33;
    protocol::cigi::ByteOrder order = protocol::cigi::ByteOrder::kLittle;
    /// UTC at the start of the flight. CIGI 3.3 carries no seconds: there the minute's second 0 is set.
    server::ephemeris::UtcClockTime utc;
    std::optional<double> visibility_m;
    std::optional<double> view_yaw_deg;
    std::uint16_t view_id = 1;
};

/// Standby first, so that every flight begins in the configured world; Operate once the image generator has
/// answered in Standby; the flight's settings and positions once it says that it operates. Should it leave
/// Operate (a restart), the settings are sent again when it is back.
class HostMessages {
  public:
    explicit HostMessages(const HostSettings& settings) noexcept : settings_(settings) {}

    /// The latest Start of Frame.
    void answered(const protocol::cigi::StartOfFrame& start_of_frame) noexcept;

    /// The next message; its bytes stay until the next call.
    /// \param pose  where the aircraft is; \param flown_s  seconds since the flight's start; \param now_ns
    /// any steady clock, for the time stamp
    [[nodiscard]] std::span<const std::byte> next(const FlightPoint& pose, double flown_s,
                                                  std::int64_t now_ns) noexcept;

    /// The number in the last message, from 1.
    [[nodiscard]] std::uint32_t frame_number() const noexcept { return frame_number_; }
    /// The image generator has said that it operates: the flight is on.
    [[nodiscard]] bool operating() const noexcept { return operating_; }

  private:
    void add_settings(protocol::cigi::MessageWriter& writer, double flown_s) const noexcept;
    void add_pose(protocol::cigi::MessageWriter& writer, const FlightPoint& pose, bool first) const noexcept;

    HostSettings settings_;
    std::array<std::byte, 512> buffer_{};
    std::uint32_t frame_number_ = 0;
    std::uint32_t last_ig_frame_number_ = 0;
    bool heard_in_standby_ = false;
    bool operating_ = false;
    bool settings_sent_ = false;
};

/// A UTC instant as the packet has it, clock running, sun, moon and stars on.
[[nodiscard]] protocol::cigi::CelestialSphereControl celestial_setting(
    const server::ephemeris::UtcClockTime& utc) noexcept;

}  // namespace skyig::clients
