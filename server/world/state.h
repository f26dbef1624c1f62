// The parts of the world's state as plain values, in the units of CIGI (degrees, metres) turned into no frame
// yet.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

#include "config/pattern.h"
#include "protocol/transport/endpoint.h"
#include "server/ephemeris/sky_state.h"
#include "server/world/authority.h"
#include "server/world/ownship_track.h"

namespace skyig::server::world {

/// What carries the eye: entity 0.
struct Ownship : Pose {
    /// False once the host has destroyed entity 0: the last pose stays, so that the picture stays.
    bool exists = true;
    /// A source has placed it since start-up or Standby.
    bool placed_by_host = false;
};

/// The ellipsoid on which the host's positions lie. Latitude and height over another than WGS84 are drawn as
/// they are told, so that up is up and the ground is the ground; distances along it are those of WGS84.
struct EarthModel {
    bool custom = false;
    double equatorial_radius_m = 6'378'137.0;
    double flattening = 1.0 / 298.257223563;

    /// Radii further from those of WGS84 than this part are refused: distances would be as wrong.
    static constexpr double kFurthest = 0.005;
    static constexpr double kFlattest = 0.005;
};

struct CelestialSwitches {
    bool sun = true;
    bool moon = true;
    bool stars = true;
    /// Fraction of the full star field intensity, 0..1.
    double star_intensity = 1.0;
};

/// The global base state of the air. Always finite; the renderer brings it to the nearest that it can draw.
struct AirState {
    bool model_enabled = true;
    /// Meteorological optical range, and the contrast that is left over at that range.
    double visibility_m = 80000.0;
    double visibility_contrast = 0.05;
    double temperature_c = 15.0;
    double pressure_hpa = 1013.25;
    double humidity_pct = 50.0;
    double wind_horizontal_m_s = 0.0;
    double wind_vertical_m_s = 0.0;
    /// Where it blows from, clockwise from true north.
    double wind_from_deg = 0.0;
};

/// Place and turn of a view or of a view group: offset along the axes of what carries it (forward, right,
/// down), then yaw, pitch, roll about the eye point.
struct ViewPose {
    glm::dvec3 offset_m{0.0};
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;

    friend bool operator==(const ViewPose&, const ViewPose&) = default;
};

/// Signed half angles from the view axis to each side.
struct HalfAngles {
    double left_deg = 0.0;
    double right_deg = 0.0;
    double bottom_deg = 0.0;
    double top_deg = 0.0;

    friend bool operator==(const HalfAngles&, const HalfAngles&) = default;
};

/// One channel's view; the order is that of the configured channels.
struct View {
    std::uint16_t view_id = 0;
    /// 0 = in no group.
    std::uint8_t group_id = 0;
    ViewPose pose;
    HalfAngles half_angles;
    /// 0 none, 1 horizontal, 2 vertical, 3 both.
    std::uint8_t mirror_mode = 0;
    /// 0 none, 1 each pixel two high, 2 two wide, 3 both.
    std::uint8_t pixel_replication = 0;
    bool orthographic = false;
    /// Shown in place of the sky.
    config::Pattern pattern = config::Pattern::kOff;
    /// 0: it has no windscreen.
    double windscreen_m = 0.0;
};

/// A source and who speaks for it, as it stands now.
struct Link {
    LinkState state = LinkState::kWaiting;
    /// Of a UDP source; meaningless while kWaiting.
    protocol::transport::Endpoint host;
    /// World time since it was last heard.
    double silent_s = 0.0;
    /// How often it was lost.
    std::uint64_t losses = 0;
};

/// What was refused or ignored by the world, each by its reason (what the decoder refuses is counted there).
struct Counters {
    std::uint64_t second_host = 0;       ///< messages of a host that is not the one its source obeys
    std::uint64_t not_in_charge = 0;     ///< data of which another source has the say
    std::uint64_t no_host = 0;           ///< packets of a source without any valid IG Control yet
    std::uint64_t standby_ignored = 0;   ///< packets other than IG Control in Standby
    std::uint64_t late_ignored = 0;      ///< packets of a message that newer ones have overtaken
    std::uint64_t frames_missed = 0;     ///< host messages that never came
    std::uint64_t entity_full = 0;       ///< no room for another entity
    std::uint64_t entity_unknown = 0;    ///< rates of an entity that is not there
    std::uint64_t rate_refused = 0;      ///< rates of a part, or such as no craft has
    std::uint64_t earth_refused = 0;     ///< an ellipsoid too far from WGS84
    std::uint64_t ownship_attached = 0;  ///< the ownship attached to a parent: its offsets mean nothing here
    std::uint64_t position_refused = 0;  ///< ownship outside the heights that are drawn
    std::uint64_t clock_refused = 0;     ///< a date and time that does not exist
    std::uint64_t air_refused = 0;       ///< values of the air that no sky has: those stay as they were
    std::uint64_t unknown_view = 0;      ///< a view id that no channel has
    std::uint64_t view_entity = 0;       ///< a view carried by another entity than the ownship
    std::uint64_t view_offset = 0;       ///< an eye further than config::kMaxOffset_m from what carries it
    std::uint64_t frustum_refused = 0;   ///< half angles that leave no picture
    std::uint64_t replication_refused = 0;  ///< a pixel replication that no standard says
    std::uint64_t weather_limited = 0;      ///< layers and regions beyond what can be drawn: the nearest is
    std::uint64_t weather_full = 0;         ///< no room for another region or layer
    std::uint64_t surface_full = 0;         ///< no room for another sea, wave or condition of the ground
    std::uint64_t surface_entity = 0;       ///< sea, waves or ground that hang on an entity
    std::uint64_t component_unknown = 0;    ///< a component that is not there, or a state that it has not
    std::uint64_t request_unknown = 0;      ///< the place of something that is not there is asked
    std::uint64_t request_full = 0;         ///< more requests wait than can be kept
    std::uint64_t event_lost = 0;           ///< more events wait than can be kept
    std::uint64_t ig_message_lost = 0;      ///< lines that Debug mode has left out

    friend bool operator==(const Counters&, const Counters&) = default;
};

struct NamedCounter {
    std::string_view name;
    std::uint64_t Counters::*value;
};

/// Every counter by name, for reports.
inline constexpr std::array kCounterNames{
    NamedCounter{"second_host", &Counters::second_host},
    NamedCounter{"not_in_charge", &Counters::not_in_charge},
    NamedCounter{"no_host", &Counters::no_host},
    NamedCounter{"standby_ignored", &Counters::standby_ignored},
    NamedCounter{"late_ignored", &Counters::late_ignored},
    NamedCounter{"frames_missed", &Counters::frames_missed},
    NamedCounter{"entity_full", &Counters::entity_full},
    NamedCounter{"entity_unknown", &Counters::entity_unknown},
    NamedCounter{"rate_refused", &Counters::rate_refused},
    NamedCounter{"earth_refused", &Counters::earth_refused},
    NamedCounter{"ownship_attached", &Counters::ownship_attached},
    NamedCounter{"position_refused", &Counters::position_refused},
    NamedCounter{"clock_refused", &Counters::clock_refused},
    NamedCounter{"air_refused", &Counters::air_refused},
    NamedCounter{"unknown_view", &Counters::unknown_view},
    NamedCounter{"view_entity", &Counters::view_entity},
    NamedCounter{"view_offset", &Counters::view_offset},
    NamedCounter{"frustum_refused", &Counters::frustum_refused},
    NamedCounter{"replication_refused", &Counters::replication_refused},
    NamedCounter{"weather_limited", &Counters::weather_limited},
    NamedCounter{"weather_full", &Counters::weather_full},
    NamedCounter{"surface_full", &Counters::surface_full},
    NamedCounter{"surface_entity", &Counters::surface_entity},
    NamedCounter{"component_unknown", &Counters::component_unknown},
    NamedCounter{"request_unknown", &Counters::request_unknown},
    NamedCounter{"request_full", &Counters::request_full},
    NamedCounter{"event_lost", &Counters::event_lost},
    NamedCounter{"ig_message_lost", &Counters::ig_message_lost},
};
static_assert(sizeof(Counters) == kCounterNames.size() * sizeof(std::uint64_t));

}  // namespace skyig::server::world
