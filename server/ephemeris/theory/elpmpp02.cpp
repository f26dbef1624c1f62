// The Moon by ELP/MPP02: Chapront & Francou 2003, A&A 404, 735; coefficients in data/.
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>

#include "server/ephemeris/theory/coordinates.h"
#include "server/ephemeris/theory/sine_series.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::server::ephemeris::theory {
namespace {

constexpr TermPair<5> kTerms[]{
#include "elpmpp02_terms.inc"
};
enum Coordinate : std::size_t { kLongitude, kLatitude, kDistance };
constexpr std::size_t kPowers = 2;
/// By coordinate, then by power of T.
constexpr TermRange kRanges[]{
#include "elpmpp02_ranges.inc"
};
static_assert(std::size(kRanges) == 3 * kPowers);

constexpr std::array kMeanLongitude_rad{3.8103440908308803, 8399.68473007193, -3.318952042550094e-5,
                                        3.1102494491060616e-8, -2.0328237648922845e-10};
// Where the ecliptic of date lies against that of J2000: sine of half their angle, times sine and cosine of
// the node.
constexpr std::array kEclipticP{0.0,           0.10180391e-4,  0.47020439e-6,
                                -0.5417367e-9, -0.2507948e-11, 0.463486e-14};
constexpr std::array kEclipticQ{0.0,           -0.113469002e-3, 0.12372674e-6,
                                0.12654170e-8, -0.1371808e-11,  -0.320334e-14};
constexpr double kObliquityJ2000_rad = 84381.40928 * kRadPerArcsecond;
/// From the dynamical equinox of J2000 to the origin of right ascension of the ICRS.
constexpr double kEquinoxOffset_rad = -0.05542 * kRadPerArcsecond;

Varying coordinate(Coordinate which, double t) noexcept {
    return poisson_series(std::span<const TermPair<5>>(kTerms),
                          std::span(kRanges).subspan(which * kPowers, kPowers), t);
}

glm::dmat3 j2000_from_ecliptic_of_date(double t) noexcept {
    const double p = polynomial(kEclipticP, t).value;
    const double q = polynomial(kEclipticQ, t).value;
    const double r = 2.0 * std::sqrt(1.0 - p * p - q * q);
    return {{1.0 - 2.0 * p * p, 2.0 * p * q, -p * r},
            {2.0 * p * q, 1.0 - 2.0 * q * q, q * r},
            {p * r, -q * r, 1.0 - 2.0 * p * p - 2.0 * q * q}};
}

glm::dmat3 icrs_from_ecliptic_j2000() noexcept {
    const double sin_obliquity = std::sin(kObliquityJ2000_rad);
    const double cos_obliquity = std::cos(kObliquityJ2000_rad);
    const double sin_offset = std::sin(kEquinoxOffset_rad);
    const double cos_offset = std::cos(kEquinoxOffset_rad);
    const glm::dmat3 equatorial_from_ecliptic{
        {1.0, 0.0, 0.0}, {0.0, cos_obliquity, sin_obliquity}, {0.0, -sin_obliquity, cos_obliquity}};
    const glm::dmat3 icrs_from_equatorial{
        {cos_offset, sin_offset, 0.0}, {-sin_offset, cos_offset, 0.0}, {0.0, 0.0, 1.0}};
    return icrs_from_equatorial * equatorial_from_ecliptic;
}

}  // namespace

PositionVelocity moon_elpmpp02(const JulianDate& tt) noexcept {
    const double t = centuries_since_j2000(tt);
    const Varying mean_longitude_rad = polynomial(kMeanLongitude_rad, t);
    const Varying longitude_arcsec = coordinate(kLongitude, t);
    const Varying latitude_arcsec = coordinate(kLatitude, t);
    const Spherical of_date{
        .longitude_rad = {mean_longitude_rad.value + longitude_arcsec.value * kRadPerArcsecond,
                          mean_longitude_rad.rate + longitude_arcsec.rate * kRadPerArcsecond},
        .latitude_rad = {latitude_arcsec.value * kRadPerArcsecond, latitude_arcsec.rate * kRadPerArcsecond},
        .distance_km = coordinate(kDistance, t)};
    // The ecliptic itself turns by 47 arcsec a century, 3e-8 km/s at the Moon: not in the velocity.
    const glm::dmat3 icrs_from_ecliptic_of_date = icrs_from_ecliptic_j2000() * j2000_from_ecliptic_of_date(t);
    return icrs_from_ecliptic_of_date * rectangular(of_date, kSecondsPerCentury);
}

}  // namespace skyig::server::ephemeris::theory
