// Sun and Moon by the low-precision formulas of The Astronomical Almanac (pages C5 and D22 of recent years).
#include <cmath>
#include <numbers>
#include <span>

#include <erfa.h>

#include "server/ephemeris/theory/coordinates.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::server::ephemeris::theory {
namespace {

/// amplitude * sin(phase + rate T), T in Julian centuries; all angles in degrees.
struct Term {
    double amplitude;
    double phase_deg;
    double rate_deg;
};

// The Sun: the Almanac's rates are per day.
constexpr double kSunLongitude_deg = 280.460;
constexpr double kSunLongitudeRate_deg = 0.9856474 * kDaysPerCentury;
constexpr double kSunAnomaly_deg = 357.528;
constexpr double kSunAnomalyRate_deg = 0.9856003 * kDaysPerCentury;
constexpr Term kSunLongitudeTerms_deg[]{{1.915, kSunAnomaly_deg, kSunAnomalyRate_deg},
                                        {0.020, 2.0 * kSunAnomaly_deg, 2.0 * kSunAnomalyRate_deg}};
constexpr double kSunDistance_au = 1.00014;
constexpr Term kSunDistanceTerms_au[]{{-0.01671, kSunAnomaly_deg + 90.0, kSunAnomalyRate_deg},
                                      {-0.00014, 2.0 * kSunAnomaly_deg + 90.0, 2.0 * kSunAnomalyRate_deg}};
/// The Almanac's longitude is where the Sun is seen, behind its place by annual aberration.
constexpr double kAberration_rad = 20.4955 * kRadPerArcsecond;

constexpr double kMoonLongitude_deg = 218.32;
constexpr double kMoonLongitudeRate_deg = 481267.883;
constexpr Term kMoonLongitudeTerms_deg[]{{6.29, 134.9, 477198.85}, {-1.27, 259.2, -413335.38},
                                         {0.66, 235.7, 890534.23}, {0.21, 269.9, 954397.70},
                                         {-0.19, 357.5, 35999.05}, {-0.11, 186.6, 966404.05}};
constexpr Term kMoonLatitudeTerms_deg[]{
    {5.13, 93.3, 483202.03}, {0.28, 228.2, 960400.87}, {-0.28, 318.3, 6003.18}, {-0.17, 217.6, -407332.20}};
constexpr double kMoonParallax_deg = 0.9508;
constexpr Term kMoonParallaxTerms_deg[]{{0.0518, 134.9 + 90.0, 477198.85},
                                        {0.0095, 259.2 + 90.0, -413335.38},
                                        {0.0078, 235.7 + 90.0, 890534.23},
                                        {0.0028, 269.9 + 90.0, 954397.70}};
/// What the Moon's horizontal parallax is the angle of.
constexpr double kEarthRadius_km = 6378.14;

/// By how much longitudes counted from the equinox of date grow for a body that stands still.
constexpr double kPrecessionRate_rad = 5028.796 * kRadPerArcsecond;

/// constant + rate T + terms, in the terms' unit.
Varying sum(double constant, double rate, std::span<const Term> terms, double t) noexcept {
    Varying out{.value = constant + rate * t, .rate = rate};
    for (const Term& term : terms) {
        const double angle_rad = (term.phase_deg + term.rate_deg * t) * kRadPerDegree;
        out.value += term.amplitude * std::sin(angle_rad);
        out.rate += term.amplitude * std::cos(angle_rad) * term.rate_deg * kRadPerDegree;
    }
    return out;
}

Varying operator*(double scale, const Varying& varying) noexcept {
    return {.value = scale * varying.value, .rate = scale * varying.rate};
}

/// Place and motion, in ICRS axes, of a body given by ecliptic and mean equinox of date.
PositionVelocity icrs_from_mean_of_date(Spherical of_date, const JulianDate& tt) noexcept {
    of_date.longitude_rad.rate -= kPrecessionRate_rad;
    const JulianDate date = within_reach(tt);
    double rows[3][3]{};
    eraEcm06(date.day, date.fraction, rows);
    // The library's matrix leads to the ecliptic of date. Its rows, as columns here, are its transpose.
    const glm::dmat3 icrs_from_ecliptic{{rows[0][0], rows[0][1], rows[0][2]},
                                        {rows[1][0], rows[1][1], rows[1][2]},
                                        {rows[2][0], rows[2][1], rows[2][2]}};
    return icrs_from_ecliptic * rectangular(of_date, kSecondsPerCentury);
}

}  // namespace

EarthMotion earth_almanac(const JulianDate& tt) noexcept {
    const double t = centuries_since_j2000(tt);
    const Varying sun_longitude_rad =
        kRadPerDegree * sum(kSunLongitude_deg, kSunLongitudeRate_deg, kSunLongitudeTerms_deg, t);
    // Seen from the Sun the Earth stands opposite.
    const Spherical earth{.longitude_rad = {sun_longitude_rad.value + kAberration_rad + std::numbers::pi,
                                            sun_longitude_rad.rate},
                          .latitude_rad = {},
                          .distance_km = kKmPerAu * sum(kSunDistance_au, 0.0, kSunDistanceTerms_au, t)};
    const PositionVelocity heliocentric = icrs_from_mean_of_date(earth, tt);
    return {.heliocentric = heliocentric, .barycentric = heliocentric};
}

PositionVelocity moon_almanac(const JulianDate& tt) noexcept {
    const double t = centuries_since_j2000(tt);
    const Varying parallax_rad = kRadPerDegree * sum(kMoonParallax_deg, 0.0, kMoonParallaxTerms_deg, t);
    const double sine = std::sin(parallax_rad.value);
    const Spherical moon{
        .longitude_rad =
            kRadPerDegree * sum(kMoonLongitude_deg, kMoonLongitudeRate_deg, kMoonLongitudeTerms_deg, t),
        .latitude_rad = kRadPerDegree * sum(0.0, 0.0, kMoonLatitudeTerms_deg, t),
        .distance_km = {kEarthRadius_km / sine,
                        -kEarthRadius_km * std::cos(parallax_rad.value) * parallax_rad.rate / (sine * sine)}};
    return icrs_from_mean_of_date(moon, tt);
}

}  // namespace skyig::server::ephemeris::theory
