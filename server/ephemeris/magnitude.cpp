#include "server/ephemeris/magnitude.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::server::ephemeris {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

double mercury(double a) noexcept {
    return -0.60 + a * (0.0498 + a * (-0.000488 + a * 3.02e-6));
}

double venus(double a) noexcept {
    // Beyond 163.6 deg the light scattered forward by its air outweighs the crescent.
    if (a > 163.6) return 0.98 - 0.0102 * a;
    return -4.47 + a * (0.0103 + a * (5.7e-5 + a * 1.3e-7));
}

double mars(double a) noexcept {
    if (a > 50.0) return -0.367 + a * (-0.02573 + a * 0.0003445);
    return -1.601 + a * (0.02267 - a * 0.0001302);
}

double jupiter(double a) noexcept {
    return -9.395 + a * (-0.00037 + a * 0.000616);
}

double saturn(double a, double ring_inclination_rad) noexcept {
    const double sine = std::sin(ring_inclination_rad);
    return -8.914 - 1.825 * sine + 0.026 * a - 0.378 * sine * std::exp(-2.25 * a);
}

double at_unit_distances(Body planet, const PlanetLight& light) noexcept {
    const double a = std::abs(light.phase_angle_rad) * kDegPerRad;
    switch (planet) {
        case Body::kMercury:
            return mercury(a);
        case Body::kVenus:
            return venus(a);
        case Body::kMars:
            return mars(a);
        case Body::kJupiter:
            return jupiter(a);
        case Body::kSaturn:
            return saturn(a, light.ring_inclination_rad);
        case Body::kSun:
        case Body::kMoon:
            break;
    }
    return 0.0;
}

}  // namespace

double sun_magnitude(double distance_au) noexcept {
    return -26.74 + 5.0 * std::log10(distance_au);
}

double moon_magnitude(double sun_distance_au, double distance_au, double phase_angle_rad) noexcept {
    const double a = std::abs(phase_angle_rad) * kDegPerRad;
    const double a2 = a * a;
    return 0.23 + 5.0 * std::log10(sun_distance_au * distance_au) + 0.026 * a + 4e-9 * a2 * a2;
}

double planet_magnitude(Body planet, const PlanetLight& light) noexcept {
    return at_unit_distances(planet, light) + 5.0 * std::log10(light.sun_distance_au * light.distance_au);
}

double ring_inclination_rad(const glm::dvec3& to_earth, const glm::dvec3& to_sun, double centuries) noexcept {
    const double ra = (40.589 - 0.036 * centuries) / kDegPerRad;
    const double dec = (83.537 - 0.004 * centuries) / kDegPerRad;
    const glm::dvec3 pole(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec));
    const double earth_rad = std::asin(std::clamp(glm::dot(pole, to_earth), -1.0, 1.0));
    const double sun_rad = std::asin(std::clamp(glm::dot(pole, to_sun), -1.0, 1.0));
    return std::sqrt(std::max(earth_rad * sun_rad, 0.0));
}

}  // namespace skyig::server::ephemeris
