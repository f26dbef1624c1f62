// The part of the sky that changes over minutes, not frames: what the series give, before Earth rotation and
// site.
#pragma once

#include <glm/glm.hpp>

#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris {

/// Geometric geocentric positions at one TT, GCRS axes, km and km/s. Velocities are barycentric: they serve
/// light time.
struct SlowSky {
    glm::dvec3 sun_km{0.0};
    glm::dvec3 sun_velocity_km_s{0.0};
    glm::dvec3 moon_km{0.0};
    glm::dvec3 moon_velocity_km_s{0.0};
    glm::dvec3 earth_velocity_km_s{0.0};
    /// Celestial intermediate frame (CIO based) from GCRS: frame bias, precession, nutation.
    glm::dmat3 cirs_from_gcrs{1.0};
};

/// The series at `tt`: eraEpv00, eraMoon98, eraC2i00b. 33 microseconds.
[[nodiscard]] SlowSky evaluate_slow_sky(const JulianDate& tt) noexcept;

/// Linear interpolation, 0 <= fraction <= 1.
[[nodiscard]] SlowSky interpolate(const SlowSky& from, const SlowSky& to, double fraction) noexcept;

/// Earth rotation, site, parallax, light time and aberration on top of `slow`, which has to be that of
/// `instant.tt`.
[[nodiscard]] SkyState sky_state_from(const SlowSky& slow, const Instant& instant,
                                      const Geodetic& eye) noexcept;

}  // namespace skyig::server::ephemeris
