#include "server/ephemeris/moon_face.h"

#include <cmath>
#include <numbers>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/rotations.h"

namespace skyig::server::ephemeris {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// Inclination of the mean lunar equator to the ecliptic (IAU).
constexpr double kEquatorInclination_rad = 1.54242 * kRadPerDeg;

}  // namespace

glm::dmat3 gcrs_from_selenographic(const JulianDate& tt, const EarthFrame& frame) noexcept {
    const double t = ((tt.day - 2451545.0) + tt.fraction) / 36525.0;
    const double latitude_argument_deg = 93.2720950 + t * (483202.0175233 - 0.0036539 * t);
    const double node_deg = 125.0445479 + t * (-1934.1362891 + 0.0020754 * t);
    const double latitude_argument_rad = std::fmod(latitude_argument_deg, 360.0) * kRadPerDeg;
    const double node_rad = std::fmod(node_deg, 360.0) * kRadPerDeg;
    // The node counts from the mean equinox, the ecliptic frame at hand from the true one.
    const glm::dmat3 selenographic_from_gcrs = rotation_about_z(latitude_argument_rad + std::numbers::pi) *
                                               rotation_about_x(-kEquatorInclination_rad) *
                                               rotation_about_z(node_rad + frame.nutation_in_longitude_rad) *
                                               rotation_about_x(frame.true_obliquity_rad) *
                                               frame.true_of_date_from_gcrs;
    return glm::transpose(selenographic_from_gcrs);
}

MoonFace moon_face(const MoonView& view) noexcept {
    const auto spherical = [&view](const glm::dvec3& direction) {
        const glm::dvec3 d = direction * view.axes_from_selenographic;
        return glm::dvec2(std::atan2(d.y, d.x), std::atan2(d.z, std::hypot(d.x, d.y)));
    };
    const glm::dvec2 subearth = spherical(-view.direction);
    const glm::dvec2 subsolar = spherical(view.to_sun);
    const glm::dvec3 axis = view.axes_from_selenographic[2];
    return {.subearth_longitude_rad = subearth.x,
            .subearth_latitude_rad = subearth.y,
            .subsolar_longitude_rad = subsolar.x,
            .subsolar_latitude_rad = subsolar.y,
            .axis_of_date_rad = position_angle_rad(view.direction, axis, view.pole_of_date),
            .axis_j2000_rad = position_angle_rad(view.direction, axis, view.pole_j2000)};
}

}  // namespace skyig::server::ephemeris
