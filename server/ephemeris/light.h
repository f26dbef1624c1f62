// What light does on its way from a body to a moving eye: it takes time, the Sun bends it, the eye's motion
// turns it. Axes GCRS, km, velocities in units of the speed of light where the name says so.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace skyig::server::ephemeris {

inline constexpr double kSpeedOfLight_km_s = 299792.458;

/// From the eye now to the body when the light left it; both places geocentric now, the body's velocity
/// barycentric. The second step leaves 4 m of the Moon's 40 km.
[[nodiscard]] inline glm::dvec3 light_path(const glm::dvec3& body_km, const glm::dvec3& velocity_km_s,
                                           const glm::dvec3& eye_km) noexcept {
    const glm::dvec3 geometric_km = body_km - eye_km;
    glm::dvec3 path_km = geometric_km;
    for (int step = 0; step < 2; ++step)
        path_km = geometric_km - velocity_km_s * (glm::length(path_km) / kSpeedOfLight_km_s);
    return path_km;
}

/// The eye's barycentric motion, ready to turn directions by aberration.
class Aberration {
  public:
    explicit Aberration(const glm::dvec3& velocity_c) noexcept
        : velocity_c_(velocity_c),
          inverse_gamma_(std::sqrt(1.0 - glm::dot(velocity_c, velocity_c))),
          share_(1.0 / (1.0 + inverse_gamma_)) {}

    /// Lorentz transformation of the unit direction to a source: a unit vector again.
    [[nodiscard]] glm::dvec3 apparent(const glm::dvec3& direction) const noexcept {
        const double along = glm::dot(direction, velocity_c_);
        return (direction * inverse_gamma_ + velocity_c_ * (1.0 + along * share_)) * (1.0 / (1.0 + along));
    }

  private:
    glm::dvec3 velocity_c_;
    double inverse_gamma_;
    double share_;
};

/// Bending by the Sun's mass to first order (Explanatory Supplement 2013, 7.63; 1.75 arcsec at the limb). All
/// directions are unit vectors: `direction` eye to source, `source_from_sun`, `eye_from_sun` (for a star
/// `source_from_sun` is `direction`). A source before the Sun is bent next to nothing; behind the disc,
/// within 0.08 deg of its centre, the bending falls to zero instead of growing without bound.
[[nodiscard]] inline glm::dvec3 deflected(const glm::dvec3& direction, const glm::dvec3& source_from_sun,
                                          const glm::dvec3& eye_from_sun, double sun_distance_au) noexcept {
    constexpr double kSchwarzschildRadius_au = 1.97412574336e-8;
    constexpr double kLeast = 1e-6;
    const double alignment = 1.0 + glm::dot(source_from_sun, eye_from_sun);
    const double weight = kSchwarzschildRadius_au / sun_distance_au / std::max(alignment, kLeast);
    return glm::normalize(direction +
                          weight * glm::cross(direction, glm::cross(eye_from_sun, source_from_sun)));
}

}  // namespace skyig::server::ephemeris
