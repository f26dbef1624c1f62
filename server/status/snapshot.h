// The daemon as it stands after one frame, as plain values of fixed size: what the frame loop hands to
// whoever tells others of it. Names, addresses and all else that does not change in a run are in Facts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "config/config.h"
#include "protocol/canaerospace/receiver.h"
#include "protocol/cigi/counters.h"
#include "protocol/cigi/packets.h"
#include "protocol/cigi/wire.h"
#include "protocol/flightgear/net_fdm.h"
#include "protocol/transport/udp.h"
#include "server/ephemeris/time.h"
#include "server/status/channel_health.h"
#include "server/status/frame_record.h"
#include "server/status/pass_state.h"
#include "server/world/state.h"

namespace skyig::server::status {

/// The host and the [[source]] tables.
inline constexpr std::size_t kMostSources = config::kMaxSources + 1;

struct Times {
    double median_ms = 0.0;
    double p95_ms = 0.0;
    double largest_ms = 0.0;
};

struct FlightGearCounts {
    std::uint64_t packets = 0;
    std::array<std::uint64_t, protocol::flightgear::kReasons> refused{};
};

struct SourceState {
    world::Link link;
    /// Datagrams or CAN frames that it has sent.
    std::uint64_t arrivals = 0;
    /// How often it spoke of an aspect that is its to speak of while another held it.
    std::array<std::uint64_t, config::kAspectCount> overruled{};
};

struct AspectState {
    std::optional<std::size_t> holder;
    world::HoldReason reason = world::HoldReason::kFirst;
};

/// What is drawn.
struct WorldState {
    protocol::cigi::IgMode mode = protocol::cigi::IgMode::kStandby;
    ephemeris::UtcClockTime utc;
    bool clock_running = false;
    double scene_time_s = 0.0;
    world::Ownship ownship;
    world::AirState air;
    /// Airless, topocentric.
    double sun_elevation_deg = 0.0;
    double sun_azimuth_deg = 0.0;
    double moon_elevation_deg = 0.0;
    double moon_azimuth_deg = 0.0;
    double moon_lit_fraction = 0.0;
    double adaptation_cd_m2 = 0.0;
};

struct Snapshot {
    /// Frames begun; 0: nothing has been drawn yet.
    std::uint64_t frames = 0;
    double elapsed_s = 0.0;
    std::uint64_t late_frames = 0;
    std::uint64_t slots_left_out = 0;
    FrameRecord record;
    Times input;
    Times shared;
    Times frame;
    std::array<Times, config::kMaxChannels> channels{};
    std::array<ChannelHealth, config::kMaxChannels> health{};

    WorldState world;
    std::array<PassState, kMostPasses> passes{};
    std::size_t pass_count = 0;

    std::array<SourceState, kMostSources> sources{};
    std::array<AspectState, config::kAspectCount> aspects{};
    /// Whose link the answers go to; its protocol, if it has spoken.
    std::size_t control_source = 0;
    protocol::cigi::Version host_version = protocol::cigi::Version::k33;
    protocol::cigi::ByteOrder host_order = protocol::cigi::ByteOrder::kLittle;
    std::uint32_t frames_behind_median = 0;
    std::uint32_t frames_behind_largest = 0;

    std::uint64_t datagrams = 0;
    protocol::cigi::Counters cigi;
    world::Counters refused;
    protocol::transport::UdpCounters udp;
    /// By source; zeros where it speaks something else.
    std::array<protocol::canaerospace::Counters, kMostSources> canaerospace{};
    std::array<FlightGearCounts, kMostSources> flightgear{};

    std::uint64_t start_of_frame_sent = 0;
    std::uint64_t start_of_frame_failed = 0;
    std::uint64_t images_written = 0;
    std::uint64_t images_failed = 0;
    std::uint64_t image_frames_skipped = 0;
    std::uint64_t gl_errors = 0;
    std::uint64_t gl_resets = 0;
    bool date_clamped = false;
    bool leap_seconds_assumed = false;
};
static_assert(std::is_trivially_copyable_v<Snapshot>, "a copy of it must not allocate");

struct SourceFacts {
    std::string name;
    config::SourceKind kind = config::SourceKind::kCigi;
    config::Rights rights;
    /// "127.0.0.1:8004", "can0"; empty where nothing is listened to.
    std::string heard_at;
};

struct Facts {
    std::string version;
    /// What draws, for people.
    std::string renderer;
    double rate_hz = 0.0;
    /// In the order of the settings.
    std::vector<std::string> channels;
    /// The host first.
    std::vector<SourceFacts> sources;
    std::string ephemeris;
    /// Days of the file of Earth orientation; empty without one.
    std::string earth_orientation;
    /// Of the run: by the clock that tells ages, and as UTC.
    std::int64_t started_ns = 0;
    std::string started_utc;
};

/// By which rule a holder has an aspect: "only_owner" where the settings give it to nobody else, else one of
/// world::kHoldReasonNames.
[[nodiscard]] std::string_view hold_rule(const Facts& facts, config::Aspect aspect,
                                         world::HoldReason reason) noexcept;

}  // namespace skyig::server::status
