// The theories that the ERFA library carries, in our units.
#include <array>
#include <cstddef>
#include <optional>

#include <erfa.h>

#include "server/ephemeris/theory/coordinates.h"
#include "server/ephemeris/theory/planets.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::server::ephemeris::theory {
namespace {

using ErfaPositionVelocity = double[2][3];

PositionVelocity in_km(const ErfaPositionVelocity& au_and_au_per_day) noexcept {
    const auto& [p, v] = au_and_au_per_day;
    return {.position_km = kKmPerAu * glm::dvec3(p[0], p[1], p[2]),
            .velocity_km_s = kKmPerAu / kSecondsPerDay * glm::dvec3(v[0], v[1], v[2])};
}

}  // namespace

EarthMotion earth_epv00(const JulianDate& tt) noexcept {
    const JulianDate date = within_reach(tt);
    ErfaPositionVelocity heliocentric{};
    ErfaPositionVelocity barycentric{};
    // Its status says only whether the year is in 1900-2100.
    static_cast<void>(eraEpv00(date.day, date.fraction, heliocentric, barycentric));
    return {.heliocentric = in_km(heliocentric), .barycentric = in_km(barycentric)};
}

PositionVelocity moon_moon98(const JulianDate& tt) noexcept {
    const JulianDate date = within_reach(tt);
    ErfaPositionVelocity moon{};
    eraMoon98(date.day, date.fraction, moon);
    return in_km(moon);
}

PositionVelocity planet_plan94(Body planet, const JulianDate& tt) noexcept {
    const std::optional<std::size_t> row = planet_row(planet);
    if (!row) return {};
    // The library's 3 is the barycentre of Earth and Moon.
    constexpr std::array<int, kPlanetCount> kNumbers{1, 2, 4, 5, 6};
    const JulianDate date = within_reach(tt);
    ErfaPositionVelocity heliocentric{};
    // Mean equator and equinox of J2000: 0.02 arcsec from the ICRS, a hundredth of the theory's error. Its
    // status says only whether the year is in 1000-3000.
    static_cast<void>(eraPlan94(date.day, date.fraction, kNumbers[*row], heliocentric));
    return in_km(heliocentric);
}

}  // namespace skyig::server::ephemeris::theory
