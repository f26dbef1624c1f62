// The daemon as it stands after one frame, as plain values of fixed size: what the frame loop hands to
// whoever tells others of it. Names, addresses and all else that does not change in a run are in Facts.
#pragma once

#include <array>
#include <bitset>
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
#include "server/status/delay.h"
#include "server/status/frame_record.h"
#include "server/status/pass_state.h"
#include "server/status/rig_state.h"
#include "server/world/state.h"

namespace skyig::server::status {

/// The host and the [[source]] tables.
inline constexpr std::size_t kMostSources = config::kMaxSources + 1;

struct Times {
    double median_ms = 0.0;
    double p95_ms = 0.0;
    double largest_ms = 0.0;
};

/// What frames leave out for the frame rate's sake, by the numbers of config::Thinning.
struct Thinning {
    std::uint64_t thinned = 0;
    std::uint64_t times_thinned = 0;
    std::uint64_t times_returned = 0;
    bool exhausted = false;
    /// The last step: what, whether it was left out by it, and what part of the period a frame had taken.
    bool any_step = false;
    bool last_thinned = false;
    std::size_t last_thing = 0;
    double last_load = 0.0;
};

struct FlightGearCounts {
    std::uint64_t packets = 0;
    std::array<std::uint64_t, protocol::flightgear::kReasons> refused{};
};

struct SourceState {
    world::Link link;
    config::Rights rights;
    /// Datagrams or CAN frames that it has sent.
    std::uint64_t arrivals = 0;
    /// How often it spoke of an aspect that is its to speak of while another held it.
    std::array<std::uint64_t, config::kAspectCount> overruled{};
};

struct AspectState {
    std::optional<std::size_t> holder;
    world::HoldReason reason = world::HoldReason::kFirst;
};

/// Global weather layers that are told one by one; more are only counted.
inline constexpr std::size_t kMostLayers = 32;

/// What is drawn.
struct WorldState {
    protocol::cigi::IgMode mode = protocol::cigi::IgMode::kStandby;
    ephemeris::UtcClockTime utc;
    bool clock_running = false;
    double scene_time_s = 0.0;
    world::Ownship ownship;
    world::AirState air;
    /// As they were set; what is on its way there is `transition_s` of the facts.
    std::array<protocol::cigi::WeatherControl, kMostLayers> layers{};
    std::size_t layer_count = 0;
    std::size_t layers_left_out = 0;
    /// Airless, topocentric.
    double sun_elevation_deg = 0.0;
    double sun_azimuth_deg = 0.0;
    double moon_elevation_deg = 0.0;
    double moon_azimuth_deg = 0.0;
    double moon_lit_fraction = 0.0;
    double adaptation_cd_m2 = 0.0;
};

/// How often the settings were read anew while the daemon ran.
struct SettingsState {
    std::uint64_t times_taken = 0;
    std::uint64_t times_refused = 0;
    /// 0: they are those of the start.
    std::int64_t last_taken_utc_ns = 0;
};

struct Snapshot {
    /// Frames begun; 0: nothing has been drawn yet.
    std::uint64_t frames = 0;
    double elapsed_s = 0.0;
    std::uint64_t late_frames = 0;
    std::uint64_t slots_left_out = 0;
    /// By the clock, where the display should have.
    std::uint64_t frames_spaced = 0;
    FrameRecord record;
    Times input;
    Times shared;
    Times frame;
    std::array<Times, config::kMaxChannels> channels{};
    std::array<ChannelHealth, config::kMaxChannels> health{};
    /// Their windows' monitors are gone.
    std::bitset<config::kMaxChannels> hidden;

    /// From a message's arrival in the kernel until each channel is finished, until all have been handed on.
    std::array<Delay, config::kMaxChannels> delays{};
    Delay delay_shown;
    /// Of the host in control: from one message to the next; by how much they come late.
    Delay host_interval;
    Delay host_jitter;
    /// Frames that went on without the host's answer.
    std::uint64_t host_timeouts = 0;
    Thinning thinning;
    std::size_t gl_objects = 0;
    SettingsState settings;
    RigState rig;

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
    /// "127.0.0.1:8004", "can0"; empty where nothing is listened to.
    std::string heard_at;
};

struct Facts {
    std::string version;
    /// What draws, for people.
    std::string renderer;
    double rate_hz = 0.0;
    /// "clock", "display", "host".
    std::string pace;
    /// What may be left out, in order.
    std::vector<std::string> thinning_order;
    /// In the order of the settings.
    std::vector<std::string> channels;
    /// Of each channel the machine that draws it; empty where this machine is alone.
    std::vector<std::string> channel_nodes;
    /// The host first.
    std::vector<SourceFacts> sources;
    /// Of the settings: what layers' heights count from there, and how long a change of weather takes.
    double elevation_m = 0.0;
    double transition_s = 0.0;
    std::string ephemeris;
    /// Days of the file of Earth orientation; empty without one.
    std::string earth_orientation;
    /// Of the run: by the clock that tells ages, and as UTC.
    std::int64_t started_ns = 0;
    std::string started_utc;
};

/// By which rule a holder has an aspect: "only_owner" where the settings give it to nobody else, else one of
/// world::kHoldReasonNames.
[[nodiscard]] std::string_view hold_rule(const Facts& facts, const Snapshot& snapshot, config::Aspect aspect,
                                         world::HoldReason reason) noexcept;

}  // namespace skyig::server::status
