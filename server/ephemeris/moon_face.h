// Which side of the Moon is seen, lit, and up: optical libration (Meeus, Astronomical Algorithms, ch. 53).
#pragma once

#include <glm/glm.hpp>

#include "server/ephemeris/earth_frame.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris {

/// Angles of the Moon's face. Selenographic longitude is east positive as seen on the Moon (towards Mare
/// Crisium), -pi..pi, latitude north positive.
struct MoonFace {
    /// The point that has the eye in its zenith; for an eye in the Earth's centre the libration.
    double subearth_longitude_rad = 0.0;
    double subearth_latitude_rad = 0.0;
    double subsolar_longitude_rad = 0.0;
    double subsolar_latitude_rad = 0.0;
    /// Position angle of the Moon's north pole, from the celestial pole through east, -pi..pi: the pole of
    /// date, and that of J2000.0 (which published tables mostly mean; they differ by up to 0.6 deg in
    /// 1900-2100).
    double axis_of_date_rad = 0.0;
    double axis_j2000_rad = 0.0;
};

/// GCRS from selenographic axes (x to the mean Earth point, z to the lunar north pole). The mean rotation of
/// Cassini's laws, without physical libration: 0.04 deg.
[[nodiscard]] glm::dmat3 gcrs_from_selenographic(const JulianDate& tt, const EarthFrame& frame) noexcept;

/// All arguments in one set of axes.
struct MoonView {
    /// From the eye to the Moon, and from the Moon to the Sun.
    glm::dvec3 direction{1.0, 0.0, 0.0};
    glm::dvec3 to_sun{-1.0, 0.0, 0.0};
    glm::dmat3 axes_from_selenographic{1.0};
    glm::dvec3 pole_of_date{0.0, 0.0, 1.0};
    glm::dvec3 pole_j2000{0.0, 0.0, 1.0};
};

[[nodiscard]] MoonFace moon_face(const MoonView& view) noexcept;

}  // namespace skyig::server::ephemeris
