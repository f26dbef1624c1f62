// Mercury to Saturn by VSOP87B: Bretagnon & Francou 1988, A&A 202, 309; coefficients in data/.
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>

#include "server/ephemeris/theory/coordinates.h"
#include "server/ephemeris/theory/planets.h"
#include "server/ephemeris/theory/sine_series.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::server::ephemeris::theory {
namespace {

constexpr TermPair<2> kTerms[]{
#include "vsop87b_terms.inc"
};
enum Coordinate : std::size_t { kLongitude, kLatitude, kDistance };
constexpr std::size_t kPowers = 4;
/// By planet, coordinate, and power of time.
constexpr TermRange kRanges[]{
#include "vsop87b_ranges.inc"
};
static_assert(std::size(kRanges) == kPlanetCount * 3 * kPowers);

/// ICRS from the dynamical ecliptic and equinox J2000 of the theory, as its authors give it against FK5.
constexpr glm::dmat3 kIcrsFromEcliptic{{1.0, -4.79966e-7, 0.0},
                                       {4.40360e-7, 0.917482137087, 0.397776982902},
                                       {-1.90919e-7, -0.397776982902, 0.917482137087}};

}  // namespace

PositionVelocity planet_vsop87(Body planet, const JulianDate& tt) noexcept {
    const std::optional<std::size_t> row = planet_row(planet);
    if (!row) return {};
    constexpr double kCenturiesPerMillennium = 10.0;
    const double t = centuries_since_j2000(tt) / kCenturiesPerMillennium;
    const auto coordinate = [&](Coordinate which) {
        const std::span powers = std::span(kRanges).subspan((*row * 3 + which) * kPowers, kPowers);
        return poisson_series(std::span<const TermPair<2>>(kTerms), powers, t);
    };
    const Varying distance_au = coordinate(kDistance);
    const Spherical at{.longitude_rad = coordinate(kLongitude),
                       .latitude_rad = coordinate(kLatitude),
                       .distance_km = {distance_au.value * kKmPerAu, distance_au.rate * kKmPerAu}};
    return kIcrsFromEcliptic * rectangular(at, kCenturiesPerMillennium * kSecondsPerCentury);
}

}  // namespace skyig::server::ephemeris::theory
