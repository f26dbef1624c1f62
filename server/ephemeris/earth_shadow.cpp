#include "server/ephemeris/earth_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/bodies.h"

namespace skyig::server::ephemeris {
namespace {

constexpr double kMoonRadius_km = kBodyRadii_km[index_of(Body::kMoon)];
constexpr double kSunRadius_km = kBodyRadii_km[index_of(Body::kSun)];
constexpr double kShadowingRadius_km = 1.01 * 6378.137;

/// Uncovered part of the Sun, seen from `distance` off the axis. In the shadow's plane the Sun's disc has
/// half the width of the penumbra's ring for its radius, and the Earth's reaches to the middle of that ring.
double sunlight_at(double distance, const EarthShadow& shadow) noexcept {
    const double sun_radius = 0.5 * (shadow.penumbra_radius - shadow.umbra_radius);
    const double earth_radius = 0.5 * (shadow.penumbra_radius + shadow.umbra_radius);
    return 1.0 - covered_fraction(sun_radius, earth_radius, distance);
}

/// Mean over the Moon's disc: chords across the direction to the axis, spaced so that they crowd at the limb,
/// and on each half chord Gauss's three points.
double mean_sunlight(double axis_distance, const EarthShadow& shadow) noexcept {
    constexpr int kChords = 24;
    constexpr std::array kPlaces{0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr std::array kWeights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double sum = 0.0;
    double area = 0.0;
    for (int chord = 0; chord < kChords; ++chord) {
        const double angle = std::numbers::pi * (chord + 0.5) / kChords;
        const double half_length = std::sin(angle);
        const double along = axis_distance - std::cos(angle);
        const double chord_area = half_length * half_length;
        for (std::size_t i = 0; i < kPlaces.size(); ++i) {
            sum +=
                chord_area * kWeights[i] * sunlight_at(std::hypot(along, kPlaces[i] * half_length), shadow);
        }
        area += chord_area;
    }
    return std::clamp(sum / area, 0.0, 1.0);
}

}  // namespace

EarthShadow earth_shadow(const glm::dvec3& moon_km, const glm::dvec3& sun_km) noexcept {
    const double sun_distance_km = glm::length(sun_km);
    const glm::dvec3 away_from_sun = -sun_km / sun_distance_km;
    const double behind_km = glm::dot(moon_km, away_from_sun);
    const glm::dvec3 to_axis_km = behind_km * away_from_sun - moon_km;
    const double off_axis_km = glm::length(to_axis_km);

    EarthShadow shadow;
    const double slope = std::abs(behind_km) / sun_distance_km;
    shadow.umbra_radius =
        (kShadowingRadius_km - slope * (kSunRadius_km - kShadowingRadius_km)) / kMoonRadius_km;
    shadow.penumbra_radius =
        (kShadowingRadius_km + slope * (kSunRadius_km + kShadowingRadius_km)) / kMoonRadius_km;
    if (behind_km <= 0.0) {
        // Continues what holds abreast of the Earth. Exactly before the Sun no direction is better than
        // another.
        const glm::dvec3 direction = off_axis_km > 0.0 ? to_axis_km / off_axis_km : glm::dvec3(0.0, 0.0, 1.0);
        shadow.axis = direction * (glm::length(moon_km) / kMoonRadius_km);
        return shadow;
    }
    shadow.axis = to_axis_km / kMoonRadius_km;
    const double axis_distance = off_axis_km / kMoonRadius_km;
    if (axis_distance < shadow.penumbra_radius + 1.0) shadow.sunlit = mean_sunlight(axis_distance, shadow);
    return shadow;
}

}  // namespace skyig::server::ephemeris
