// The part of the sky that changes over minutes, not frames: what the theories give, before Earth rotation
// and site.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "server/ephemeris/bodies.h"
#include "server/ephemeris/earth_shadow.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris {

/// A planet for an eye in the Earth's centre, GCRS axes.
struct SlowPlanet {
    /// From the Earth now to the planet when the light left it, bent as the Sun's mass bends it.
    glm::dvec3 path_km{1e8, 0.0, 0.0};
    /// From the planet to the Sun when the light left it, turned as the path is bent, so that the angle to
    /// the path is the phase angle. A unit vector at knots, 1e-9 shorter between them.
    glm::dvec3 to_sun{-1.0, 0.0, 0.0};
    /// For the Earth's centre.
    double magnitude = 0.0;
};

/// Geometric geocentric positions at one TT, GCRS axes, km and km/s. Velocities are barycentric: they serve
/// light time.
struct SlowSky {
    glm::dvec3 sun_km{1.496e8, 0.0, 0.0};
    glm::dvec3 sun_velocity_km_s{0.0};
    glm::dvec3 moon_km{384400.0, 0.0, 0.0};
    glm::dvec3 moon_velocity_km_s{0.0};
    glm::dvec3 earth_barycentric_km{0.0};
    glm::dvec3 earth_velocity_km_s{0.0};
    glm::dmat3 cirs_from_gcrs{1.0};
    glm::dmat3 true_of_date_from_gcrs{1.0};
    glm::dmat3 gcrs_from_selenographic{1.0};
    /// Axis in GCRS.
    EarthShadow shadow;
    std::array<SlowPlanet, kPlanetCount> planets;
};

/// The theories of `model` at `tt`.
/// kAlmanac: earth_almanac, moon_almanac, planet_elements. kErfa: epv00, moon98, plan94. kSeries: epv00,
/// ELP/MPP02, VSOP87B. Each with its earth_frame(). Cost: see docs/accuracy.
[[nodiscard]] SlowSky evaluate_slow_sky(const JulianDate& tt, Model model = Model::kSeries) noexcept;

/// Linear interpolation, 0 <= fraction <= 1.
[[nodiscard]] SlowSky interpolate(const SlowSky& from, const SlowSky& to, double fraction) noexcept;

/// Earth rotation, site, parallax, light time and aberration on top of `slow`, which has to be that of
/// `instant.tt`.
[[nodiscard]] SkyState sky_state_from(const SlowSky& slow, const Instant& instant,
                                      const Geodetic& eye) noexcept;

/// The same for an eye in the Earth's centre; what reads "enu" in the state then means the true equator and
/// equinox of date.
[[nodiscard]] SkyState geocentric_state_from(const SlowSky& slow, const JulianDate& tt) noexcept;

}  // namespace skyig::server::ephemeris
