// What the theories share: their time argument, and the way from spherical to rectangular coordinates.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

#include "server/ephemeris/theory/sine_series.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::server::ephemeris::theory {

inline constexpr double kJ2000_jd = 2451545.0;
inline constexpr double kDaysPerCentury = 36525.0;
inline constexpr double kSecondsPerDay = 86400.0;
inline constexpr double kSecondsPerCentury = kDaysPerCentury * kSecondsPerDay;
inline constexpr double kRadPerDegree = std::numbers::pi / 180.0;
inline constexpr double kRadPerArcsecond = kRadPerDegree / 3600.0;

/// How far from J2000 the polynomials of the theories are followed; they grow without bound after that.
inline constexpr double kFarthest_centuries = 50.0;

/// Julian centuries of TT since J2000, within +-kFarthest_centuries; not-a-number stays.
[[nodiscard]] inline double centuries_since_j2000(const JulianDate& tt) noexcept {
    const double centuries = ((tt.day - kJ2000_jd) + tt.fraction) / kDaysPerCentury;
    return std::clamp(centuries, -kFarthest_centuries, kFarthest_centuries);
}

/// The same limits for theories that take a Julian date. A date inside them comes back as it is.
[[nodiscard]] inline JulianDate within_reach(const JulianDate& tt) noexcept {
    const double centuries = centuries_since_j2000(tt);
    if (std::abs(centuries) < kFarthest_centuries) return tt;
    return {.day = kJ2000_jd, .fraction = centuries * kDaysPerCentury};
}

/// Longitude and latitude in rad, distance in km, with rates by any one unit of time.
struct Spherical {
    Varying longitude_rad;
    Varying latitude_rad;
    Varying distance_km;
};

[[nodiscard]] inline PositionVelocity rectangular(const Spherical& at, double seconds_per_unit) noexcept {
    const double sin_longitude = std::sin(at.longitude_rad.value);
    const double cos_longitude = std::cos(at.longitude_rad.value);
    const double sin_latitude = std::sin(at.latitude_rad.value);
    const double cos_latitude = std::cos(at.latitude_rad.value);
    const glm::dvec3 outward{cos_latitude * cos_longitude, cos_latitude * sin_longitude, sin_latitude};
    const glm::dvec3 along_longitude{-cos_latitude * sin_longitude, cos_latitude * cos_longitude, 0.0};
    const glm::dvec3 along_latitude{-sin_latitude * cos_longitude, -sin_latitude * sin_longitude,
                                    cos_latitude};
    const double distance_km = at.distance_km.value;
    const glm::dvec3 rate_km = at.distance_km.rate * outward +
                               distance_km * at.longitude_rad.rate * along_longitude +
                               distance_km * at.latitude_rad.rate * along_latitude;
    return {.position_km = distance_km * outward, .velocity_km_s = rate_km / seconds_per_unit};
}

[[nodiscard]] inline PositionVelocity operator*(const glm::dmat3& rotation,
                                                const PositionVelocity& body) noexcept {
    return {.position_km = rotation * body.position_km, .velocity_km_s = rotation * body.velocity_km_s};
}

}  // namespace skyig::server::ephemeris::theory
