// What is told of a body at one moment: the same figures for a report and for a row of a table.
#pragma once

#include <optional>

#include "server/ephemeris/bodies.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/time.h"

namespace skyig::clients::ephem {

/// Which side of the Moon is turned where, degrees. Longitudes -180..180, east towards Mare Crisium.
struct MoonFace {
    double subearth_longitude_deg = 0.0;
    double subearth_latitude_deg = 0.0;
    double subsolar_longitude_deg = 0.0;
    double subsolar_latitude_deg = 0.0;
    /// Position angle of the lunar north pole, from the north of J2000 through east, 0..360.
    double axis_position_angle_deg = 0.0;
};

struct BodyPlace {
    server::ephemeris::Body body = server::ephemeris::Body::kSun;
    /// Apparent, true equator and equinox of date, 0..360 and -90..90.
    double right_ascension_deg = 0.0;
    double declination_deg = 0.0;
    /// Light-time range.
    double range_km = 0.0;
    double semidiameter_arcsec = 0.0;
    /// Angle Sun-body-eye; 0 for the Sun itself.
    double phase_angle_deg = 0.0;
    double illuminated_fraction = 1.0;
    double magnitude = 0.0;
    /// From the north of date through east, 0..360; not for the Sun.
    std::optional<double> bright_limb_deg;
    std::optional<MoonFace> moon_face;
    /// Only seen from a site. Azimuth 0..360 from north through east; elevation airless.
    struct Horizontal {
        double azimuth_deg = 0.0;
        double elevation_deg = 0.0;
    };
    std::optional<Horizontal> horizontal;
};

/// 0 <= angle < 360, of an angle in -2 pi .. 2 pi.
[[nodiscard]] double in_circle_deg(double angle_rad) noexcept;

/// As seen from `site`, or from the Earth's centre without one (what reads "enu" then means the true equator
/// and equinox of date).
[[nodiscard]] server::ephemeris::SkyState sky_of(const server::ephemeris::Instant& instant,
                                                 const std::optional<server::ephemeris::Geodetic>& site,
                                                 server::ephemeris::Model model) noexcept;

/// \param from_site  false: the state is that of the Earth's centre
[[nodiscard]] BodyPlace place_in(const server::ephemeris::SkyState& state, server::ephemeris::Body body,
                                 bool from_site) noexcept;

}  // namespace skyig::clients::ephem
