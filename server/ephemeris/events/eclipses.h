// Eclipses of Sun and Moon as a site sees them, with the times of their contacts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "server/ephemeris/events/events.h"

namespace skyig::server::ephemeris::events {

/// One moment of an eclipse, and how high the eclipsed body's centre stands then (airless).
struct Contact {
    UtcClockTime time;
    double elevation_deg = 0.0;
};

enum class SolarEclipseKind : std::uint8_t { kPartial, kAnnular, kTotal };
inline constexpr std::array<std::string_view, 3> kSolarEclipseNames{"partial", "annular", "total"};

/// Topocentric circumstances. Contacts are of mean limbs (radii as in bodies.h): mountains on the Moon's limb
/// move them by up to 2 s.
struct SolarEclipse {
    /// What it is at the site, whether or not the Sun is up.
    SolarEclipseKind kind = SolarEclipseKind::kPartial;
    /// Outer contacts, least separation.
    Contact first;
    Contact maximum;
    Contact fourth;
    /// Inner contacts of an annular or total eclipse.
    std::optional<Contact> second;
    std::optional<Contact> third;
    /// At the maximum: part of the Sun's diameter that is covered; Moon's diameter over the Sun's when
    /// annular or total.
    double magnitude = 0.0;
    /// At the maximum: part of the Sun's area that is covered.
    double obscuration = 0.0;
    /// The same at the best moment with some of the Sun above the almanacs' horizon.
    double seen_obscuration = 0.0;
};

enum class LunarEclipseKind : std::uint8_t { kPenumbral, kPartial, kTotal };
inline constexpr std::array<std::string_view, 3> kLunarEclipseNames{"penumbral", "partial", "total"};

struct LunarEclipse {
    LunarEclipseKind kind = LunarEclipseKind::kPenumbral;
    Contact penumbra_begins;
    Contact maximum;
    Contact penumbra_ends;
    std::optional<Contact> umbra_begins;
    std::optional<Contact> umbra_ends;
    std::optional<Contact> totality_begins;
    std::optional<Contact> totality_ends;
    /// Part of the Moon's diameter inside umbra and penumbra at the maximum; over 1 when deeper in, negative
    /// when outside.
    double umbral_magnitude = 0.0;
    double penumbral_magnitude = 0.0;
};

/// Eclipses of which some part is seen: the upper limb of the eclipsed body stands above the almanacs'
/// horizon at some time between first and last contact. `span` holds the maximum.
[[nodiscard]] std::vector<SolarEclipse> find_solar_eclipses(const TimeSpan& span, const Geodetic& site,
                                                            Model model = Model::kSeries);
[[nodiscard]] std::vector<LunarEclipse> find_lunar_eclipses(const TimeSpan& span, const Geodetic& site,
                                                            Model model = Model::kSeries);

}  // namespace skyig::server::ephemeris::events
