// How bright Sun, Moon and planets are outside the air: V magnitudes by published formulas.
#pragma once

#include <glm/glm.hpp>

#include "server/ephemeris/bodies.h"

namespace skyig::server::ephemeris {

/// The Sun is -26.74 (Willmer 2018: -26.76; Allen: -26.74) at one au.
[[nodiscard]] double sun_magnitude(double distance_au) noexcept;

/// Allen, Astrophysical Quantities: 0.23 + 0.026 |a| + 4e-9 a^4, a the phase angle in degrees, and the
/// distances in au. No opposition surge, no Earth's shadow. 0.005 from JPL Horizons.
[[nodiscard]] double moon_magnitude(double sun_distance_au, double distance_au,
                                    double phase_angle_rad) noexcept;

/// What the magnitude of a planet depends on.
struct PlanetLight {
    double sun_distance_au = 1.0;
    double distance_au = 1.0;
    double phase_angle_rad = 0.0;
    /// Saturn only: inclination of the rings as they throw back light, >= 0; see ring_inclination_rad().
    double ring_inclination_rad = 0.0;
};

/// Mercury, Venus: Hilton 2005 (AJ 129, 2902). Mars, Jupiter, Saturn with rings: Mallama & Hilton 2018
/// (Astronomy and Computing 25, 10), without the rotation of Mars (0.06). Within 0.09 of JPL Horizons as of
/// 2019 (Mars; the others 0.03); fitted for phases up to 170 deg, finite for all. The Sun and the Moon have
/// no answer here: 0.
[[nodiscard]] double planet_magnitude(Body planet, const PlanetLight& light) noexcept;

/// Geometric mean of the saturnicentric latitudes of Sun and Earth, 0 when they stand on opposite sides of
/// the rings (Mallama & Hilton 2018). Directions from Saturn, GCRS axes, unit vectors; `centuries` of TT
/// since J2000.0. Pole of the IAU working group's report of 2015.
[[nodiscard]] double ring_inclination_rad(const glm::dvec3& to_earth, const glm::dvec3& to_sun,
                                          double centuries) noexcept;

}  // namespace skyig::server::ephemeris
