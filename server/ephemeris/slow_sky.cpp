#include "server/ephemeris/slow_sky.h"

#include <erfa.h>
#include <erfam.h>

#include <array>

namespace skyig::server::ephemeris {
namespace {

constexpr double kKmPerAu = ERFA_DAU / 1000.0;
constexpr double kKmPerSecondPerAuPerDay = kKmPerAu / ERFA_DAYSEC;

using PositionVelocity = double[2][3];

glm::dvec3 position_km(const PositionVelocity& pv) noexcept {
    return kKmPerAu * glm::dvec3(pv[0][0], pv[0][1], pv[0][2]);
}

glm::dvec3 velocity_km_s(const PositionVelocity& pv) noexcept {
    return kKmPerSecondPerAuPerDay * glm::dvec3(pv[1][0], pv[1][1], pv[1][2]);
}

}  // namespace

SlowSky evaluate_slow_sky(const JulianDate& tt) noexcept {
    // TT stands for TDB: they differ by under 2 ms, the Moon by 0.001 arcsec.
    PositionVelocity earth_heliocentric{};
    PositionVelocity earth_barycentric{};
    eraEpv00(tt.day, tt.fraction, earth_heliocentric, earth_barycentric);
    PositionVelocity moon_geocentric{};
    eraMoon98(tt.day, tt.fraction, moon_geocentric);
    double matrix[3][3]{};
    eraC2i00b(tt.day, tt.fraction, matrix);

    SlowSky slow;
    slow.earth_velocity_km_s = velocity_km_s(earth_barycentric);
    slow.sun_km = -position_km(earth_heliocentric);
    slow.sun_velocity_km_s = slow.earth_velocity_km_s - velocity_km_s(earth_heliocentric);
    slow.moon_km = position_km(moon_geocentric);
    slow.moon_velocity_km_s = slow.earth_velocity_km_s + velocity_km_s(moon_geocentric);
    for (glm::length_t row = 0; row < 3; ++row) {
        for (glm::length_t column = 0; column < 3; ++column)
            slow.cirs_from_gcrs[column][row] = matrix[row][column];
    }
    return slow;
}

SlowSky interpolate(const SlowSky& from, const SlowSky& to, double fraction) noexcept {
    const auto mix = [fraction](const auto& a, const auto& b) { return a + (b - a) * fraction; };
    return {.sun_km = mix(from.sun_km, to.sun_km),
            .sun_velocity_km_s = mix(from.sun_velocity_km_s, to.sun_velocity_km_s),
            .moon_km = mix(from.moon_km, to.moon_km),
            .moon_velocity_km_s = mix(from.moon_velocity_km_s, to.moon_velocity_km_s),
            .earth_velocity_km_s = mix(from.earth_velocity_km_s, to.earth_velocity_km_s),
            .cirs_from_gcrs = mix(from.cirs_from_gcrs, to.cirs_from_gcrs)};
}

}  // namespace skyig::server::ephemeris
