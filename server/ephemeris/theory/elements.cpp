// Planets on slowly changing Kepler ellipses: E. M. Standish, "Keplerian elements for approximate positions
// of the major planets" (JPL Solar System Dynamics), the set for 3000 BC - 3000 AD with its additional terms.
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "server/ephemeris/rotations.h"
#include "server/ephemeris/theory/coordinates.h"
#include "server/ephemeris/theory/planets.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::server::ephemeris::theory {
namespace {

/// Ecliptic and equinox J2000. Each element: at J2000, and its change in a Julian century.
struct Elements {
    std::array<double, 2> semi_major_axis_au;
    std::array<double, 2> eccentricity;
    std::array<double, 2> inclination_deg;
    std::array<double, 2> mean_longitude_deg;
    std::array<double, 2> perihelion_longitude_deg;
    std::array<double, 2> node_longitude_deg;
    /// Added to the mean anomaly: square T^2 + cosine cos(f T) + sine sin(f T).
    double square_deg = 0.0;
    double cosine_deg = 0.0;
    double sine_deg = 0.0;
};

/// f of the above: the great inequality of Jupiter and Saturn.
constexpr double kInequalityRate_rad = 38.35125 * kRadPerDegree;

constexpr std::array<Elements, kPlanetCount> kElements{{
    {{0.38709843, 0.0},
     {0.20563661, 0.00002123},
     {7.00559432, -0.00590158},
     {252.25166724, 149472.67486623},
     {77.45771895, 0.15940013},
     {48.33961819, -0.12214182}},
    {{0.72332102, -0.00000026},
     {0.00676399, -0.00005107},
     {3.39777545, 0.00043494},
     {181.97970850, 58517.81560260},
     {131.76755713, 0.05679648},
     {76.67261496, -0.27274174}},
    {{1.52371243, 0.00000097},
     {0.09336511, 0.00009149},
     {1.85181869, -0.00724757},
     {-4.56813164, 19140.29934243},
     {-23.91744784, 0.45223625},
     {49.71320984, -0.26852431}},
    {{5.20248019, -0.00002864},
     {0.04853590, 0.00018026},
     {1.29861416, -0.00322699},
     {34.33479152, 3034.90371757},
     {14.27495244, 0.18199196},
     {100.29282654, 0.13024619},
     -0.00012452,
     0.06064060,
     -0.35635438},
    {{9.54149883, -0.00003065},
     {0.05550825, -0.00032044},
     {2.49424102, 0.00451969},
     {50.07571329, 1222.11494724},
     {92.86136063, 0.54179478},
     {113.63998702, -0.25015002},
     0.00025899,
     -0.13434469,
     0.87320147},
}};

Varying at(const std::array<double, 2>& element, double t) noexcept {
    return {.value = element[0] + element[1] * t, .rate = element[1]};
}

Varying mean_anomaly_rad(const Elements& elements, double t) noexcept {
    const Varying longitude_deg = at(elements.mean_longitude_deg, t);
    const Varying perihelion_deg = at(elements.perihelion_longitude_deg, t);
    const double sine = std::sin(kInequalityRate_rad * t);
    const double cosine = std::cos(kInequalityRate_rad * t);
    const double added_deg =
        elements.square_deg * t * t + elements.cosine_deg * cosine + elements.sine_deg * sine;
    const double added_rate_deg =
        2.0 * elements.square_deg * t +
        kInequalityRate_rad * (elements.sine_deg * cosine - elements.cosine_deg * sine);
    return {.value = (longitude_deg.value - perihelion_deg.value + added_deg) * kRadPerDegree,
            .rate = (longitude_deg.rate - perihelion_deg.rate + added_rate_deg) * kRadPerDegree};
}

/// Kepler's equation, for eccentricities up to 0.3: converges to rounding in four steps from here.
double eccentric_anomaly_rad(double anomaly_rad, double eccentricity) noexcept {
    double eccentric_rad =
        anomaly_rad + eccentricity * std::sin(anomaly_rad) * (1.0 + eccentricity * std::cos(anomaly_rad));
    for (int step = 0; step < 4; ++step) {
        const double excess_rad = eccentric_rad - eccentricity * std::sin(eccentric_rad) - anomaly_rad;
        eccentric_rad -= excess_rad / (1.0 - eccentricity * std::cos(eccentric_rad));
    }
    return eccentric_rad;
}

/// Axes of the orbit: x to the perihelion, z to the orbit's north.
glm::dmat3 icrs_from_orbit(const Elements& elements, double t) noexcept {
    constexpr double kObliquity_rad = 23.43928 * kRadPerDegree;
    const double node_rad = at(elements.node_longitude_deg, t).value * kRadPerDegree;
    const double argument_rad = at(elements.perihelion_longitude_deg, t).value * kRadPerDegree - node_rad;
    const double inclination_rad = at(elements.inclination_deg, t).value * kRadPerDegree;
    return rotation_about_x(-kObliquity_rad) * rotation_about_z(-node_rad) *
           rotation_about_x(-inclination_rad) * rotation_about_z(-argument_rad);
}

}  // namespace

PositionVelocity planet_elements(Body planet, const JulianDate& tt) noexcept {
    const std::optional<std::size_t> row = planet_row(planet);
    if (!row) return {};
    const Elements& elements = kElements[*row];
    const double t = centuries_since_j2000(tt);
    const double major_km = at(elements.semi_major_axis_au, t).value * kKmPerAu;
    const double eccentricity = at(elements.eccentricity, t).value;
    const double minor_km = major_km * std::sqrt(1.0 - eccentricity * eccentricity);
    const Varying mean_rad = mean_anomaly_rad(elements, t);
    const double eccentric_rad = eccentric_anomaly_rad(mean_rad.value, eccentricity);
    const double sine = std::sin(eccentric_rad);
    const double cosine = std::cos(eccentric_rad);
    const double eccentric_rate_rad = mean_rad.rate / (1.0 - eccentricity * cosine);
    const glm::dvec3 in_orbit_km{major_km * (cosine - eccentricity), minor_km * sine, 0.0};
    // Of the ellipse's own changes only the turning of its axis is felt: 4e-4 of Saturn's speed.
    const double turn_rad = at(elements.perihelion_longitude_deg, t).rate * kRadPerDegree;
    const glm::dvec3 rate_km{-major_km * sine * eccentric_rate_rad - turn_rad * in_orbit_km.y,
                             minor_km * cosine * eccentric_rate_rad + turn_rad * in_orbit_km.x, 0.0};
    return icrs_from_orbit(elements, t) *
           PositionVelocity{.position_km = in_orbit_km, .velocity_km_s = rate_km / kSecondsPerCentury};
}

}  // namespace skyig::server::ephemeris::theory
