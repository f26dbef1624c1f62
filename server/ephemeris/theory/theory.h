// The theories of motion that a model of the sky is put together from. Pure functions of TT; no state, no
// allocation, thread-safe. Axes ICRS (GCRS for the Moon), kilometres, km/s. TT stands for TDB (2 ms, 0.001
// arcsec of the Moon). Meant for 1900-2100; finite for every finite date.
#pragma once

#include <glm/glm.hpp>

#include "server/ephemeris/bodies.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris::theory {

struct PositionVelocity {
    glm::dvec3 position_km{0.0};
    glm::dvec3 velocity_km_s{0.0};
};

/// The Earth's centre.
struct EarthMotion {
    PositionVelocity heliocentric;
    PositionVelocity barycentric;
};

/// VSOP2000 as fitted by ERFA (eraEpv00).
[[nodiscard]] EarthMotion earth_epv00(const JulianDate& tt) noexcept;
/// Low-precision Sun of the Astronomical Almanac, moved to ICRS; the barycentre is taken to be the Sun.
[[nodiscard]] EarthMotion earth_almanac(const JulianDate& tt) noexcept;

/// Geocentric Moon: ELP/MPP02 (Chapront & Francou 2003), terms of at least 0.01 arcsec, fitted to DE405.
[[nodiscard]] PositionVelocity moon_elpmpp02(const JulianDate& tt) noexcept;
/// Geocentric Moon: Meeus ch. 47 as in ERFA (eraMoon98).
[[nodiscard]] PositionVelocity moon_moon98(const JulianDate& tt) noexcept;
/// Geocentric Moon: low-precision formula of the Astronomical Almanac.
[[nodiscard]] PositionVelocity moon_almanac(const JulianDate& tt) noexcept;

/// Heliocentric planet, kMercury .. kSaturn: VSOP87B (Bretagnon & Francou 1988), terms of at least 1e-7 rad.
[[nodiscard]] PositionVelocity planet_vsop87(Body planet, const JulianDate& tt) noexcept;
/// Heliocentric planet by mean elements with their main perturbations (Simon et al. 1994, eraPlan94).
[[nodiscard]] PositionVelocity planet_plan94(Body planet, const JulianDate& tt) noexcept;
/// Heliocentric planet on a slowly turning Kepler ellipse (Standish, JPL approximate elements).
[[nodiscard]] PositionVelocity planet_elements(Body planet, const JulianDate& tt) noexcept;

}  // namespace skyig::server::ephemeris::theory
