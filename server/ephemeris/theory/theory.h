// The theories of motion that a model of the sky is put together from. Pure functions of TT; no state, no
// allocation, thread-safe. Places are geometric (no light time, no aberration), axes ICRS (GCRS for the
// Moon), kilometres, km/s. TT stands for TDB (2 ms, 0.001 arcsec of the Moon). Meant for 1900-2100, where the
// errors below are the greatest found; dates over 5000 years from J2000 are taken as that far, so every
// finite date gives finite numbers; not-a-number gives not-a-number. Costs: see docs/accuracy.
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

/// VSOP2000 as fitted by ERFA (eraEpv00). 0.02 arcsec; costs more than all the others together.
[[nodiscard]] EarthMotion earth_epv00(const JulianDate& tt) noexcept;
/// Low-precision Sun of the Astronomical Almanac, moved to ICRS by the precession of IAU 2006; the aberration
/// that its longitude contains is taken out. The barycentre is taken to be the Sun. 50 arcsec.
[[nodiscard]] EarthMotion earth_almanac(const JulianDate& tt) noexcept;

/// Geocentric Moon: ELP/MPP02 (Chapront & Francou 2003), terms of at least 0.01 arcsec, fitted to DE405.
/// 0.4 arcsec, 0.35 km.
[[nodiscard]] PositionVelocity moon_elpmpp02(const JulianDate& tt) noexcept;
/// Geocentric Moon: Meeus ch. 47 as in ERFA (eraMoon98). 11 arcsec.
[[nodiscard]] PositionVelocity moon_moon98(const JulianDate& tt) noexcept;
/// Geocentric Moon: low-precision formula of the Astronomical Almanac, moved to ICRS by the precession of IAU
/// 2006. 1300 arcsec.
[[nodiscard]] PositionVelocity moon_almanac(const JulianDate& tt) noexcept;

// Heliocentric planets, kMercury .. kSaturn (Jupiter and Saturn with their moons); zero for Sun and Moon.
// Errors are angles at the Sun; from the Earth they are larger by the ratio of the distances, up to 2.6 for
// Venus and 4 for Mars.

/// VSOP87B (Bretagnon & Francou 1988), terms of at least 1e-7 rad. 0.4 arcsec against the whole theory.
[[nodiscard]] PositionVelocity planet_vsop87(Body planet, const JulianDate& tt) noexcept;
/// Mean elements with their main perturbations (Simon et al. 1994, eraPlan94). Mercury to Saturn 4, 7, 26,
/// 67, 88 arcsec; velocity within 0.4 %.
[[nodiscard]] PositionVelocity planet_plan94(Body planet, const JulianDate& tt) noexcept;
/// A slowly turning Kepler ellipse (Standish, JPL approximate elements for 3000 BC - 3000 AD). Mercury to
/// Saturn 27, 38, 182, 660, 1263 arcsec.
[[nodiscard]] PositionVelocity planet_elements(Body planet, const JulianDate& tt) noexcept;

}  // namespace skyig::server::ephemeris::theory
