#include "server/ephemeris/angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::server::ephemeris {

double turn_from_zero(double angle_rad) noexcept {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double positive = angle_rad < 0.0 ? angle_rad + kTurn : angle_rad;
    return positive < kTurn ? positive : 0.0;
}

double angle_between_rad(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

double covered_fraction(double radius, double covering_radius, double separation) noexcept {
    if (separation >= radius + covering_radius) return 0.0;
    if (separation <= covering_radius - radius) return 1.0;
    if (separation <= radius - covering_radius) {
        const double ratio = covering_radius / radius;
        return ratio * ratio;
    }
    // Two circular segments on the common chord; each is r^2 (a - sin a cos a) with a half the angle of its
    // arc.
    const auto segment = [separation](double r, double other) {
        const double to_chord = (separation * separation + (r - other) * (r + other)) / (2.0 * separation);
        const double half_chord = std::sqrt(std::max((r - to_chord) * (r + to_chord), 0.0));
        return r * r * std::atan2(half_chord, to_chord) - to_chord * half_chord;
    };
    const double lens = segment(radius, covering_radius) + segment(covering_radius, radius);
    return std::clamp(lens / (std::numbers::pi * radius * radius), 0.0, 1.0);
}

Equatorial equatorial_of(const glm::dvec3& direction) noexcept {
    return {.right_ascension_rad = turn_from_zero(std::atan2(direction.y, direction.x)),
            .declination_rad = std::atan2(direction.z, std::hypot(direction.x, direction.y))};
}

Horizontal horizontal_of(const glm::dvec3& direction_enu) noexcept {
    return {.azimuth_rad = turn_from_zero(std::atan2(direction_enu.x, direction_enu.y)),
            .elevation_rad = std::atan2(direction_enu.z, std::hypot(direction_enu.x, direction_enu.y))};
}

double position_angle_rad(const glm::dvec3& direction, const glm::dvec3& towards,
                          const glm::dvec3& pole) noexcept {
    const glm::dvec3 east = glm::cross(pole, direction);
    const glm::dvec3 north = glm::cross(direction, east);
    return std::atan2(glm::dot(towards, east), glm::dot(towards, north));
}

}  // namespace skyig::server::ephemeris
