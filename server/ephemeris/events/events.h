// When things happen in the sky: rise, set and transit, twilights, phases of the Moon, seasons, eclipses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "server/ephemeris/bodies.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris::events {

enum class EventKind : std::uint8_t {
    kRise,
    kSet,
    kTransit,
    kAstronomicalDawn,
    kNauticalDawn,
    kCivilDawn,
    kCivilDusk,
    kNauticalDusk,
    kAstronomicalDusk,
    kNewMoon,
    kFirstQuarter,
    kFullMoon,
    kLastQuarter,
    kMarchEquinox,
    kJuneSolstice,
    kSeptemberEquinox,
    kDecemberSolstice,
    kPerihelion,
    kAphelion
};

/// Names as they are printed, in the order of EventKind.
inline constexpr std::array<std::string_view, 19> kEventNames{"rise",
                                                              "set",
                                                              "transit",
                                                              "astronomical_dawn",
                                                              "nautical_dawn",
                                                              "civil_dawn",
                                                              "civil_dusk",
                                                              "nautical_dusk",
                                                              "astronomical_dusk",
                                                              "new_moon",
                                                              "first_quarter",
                                                              "full_moon",
                                                              "last_quarter",
                                                              "march_equinox",
                                                              "june_solstice",
                                                              "september_equinox",
                                                              "december_solstice",
                                                              "perihelion",
                                                              "aphelion"};

[[nodiscard]] constexpr std::string_view name_of(EventKind kind) noexcept {
    return kEventNames[static_cast<std::size_t>(kind)];
}

struct Event {
    UtcClockTime time;
    EventKind kind = EventKind::kRise;
    Body body = Body::kSun;
    /// Airless direction of the body's centre at the site; not-a-number for phases and seasons.
    double azimuth_deg = std::numeric_limits<double>::quiet_NaN();
    double elevation_deg = std::numeric_limits<double>::quiet_NaN();
};

/// Events from `from` on and before `to`.
struct TimeSpan {
    UtcClockTime from;
    UtcClockTime to;
};

/// The almanacs' horizon: a body rises and sets when its upper limb, airless, stands 34 arcmin below the
/// horizontal plane, whatever the height of the eye.
inline constexpr double kAlmanacHorizon_rad = -34.0 / 60.0 * std::numbers::pi / 180.0;

struct LocalSearch {
    /// Whose rise, set and upper transit.
    std::span<const Body> bodies;
    /// Centre of the Sun, airless, at -6, -12 and -18 degrees.
    bool twilights = true;
    /// Airless elevation of the upper limb at rise and set.
    double horizon_rad = kAlmanacHorizon_rad;
};

/// What happens at a site, in order of time. Two crossings of the horizon are found however close they are to
/// each other; a body that only touches it, to 0.001 arcsec, may be missed. Where nothing happens (a polar
/// night, a circumpolar planet) nothing is returned.
///
/// Times are within a minute of published tables (rise and set near the poles take longer than that).
/// Cost: 1.3 s for a year with Sun, Moon and twilights.
[[nodiscard]] std::vector<Event> find_local_events(const TimeSpan& span, const Geodetic& site,
                                                   const LocalSearch& search, Model model = Model::kSeries);

/// Quarters of the Moon: its apparent geocentric ecliptic longitude leads the Sun's by 0, 90, 180, 270
/// degrees.
[[nodiscard]] std::vector<Event> find_moon_phases(const TimeSpan& span, Model model = Model::kSeries);

/// Equinoxes and solstices (apparent geocentric longitude of the Sun 0, 90, 180, 270 degrees of date), and
/// the Earth's perihelia and aphelia (least and largest distance of the centres of Earth and Sun).
[[nodiscard]] std::vector<Event> find_seasons(const TimeSpan& span, Model model = Model::kSeries);

}  // namespace skyig::server::ephemeris::events
