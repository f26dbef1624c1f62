#include "server/weather/eye_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::server::weather {
namespace {

using ephemeris::Geodetic;

/// Mean radius; that of a chord's own circle differs by less than 0.6 %, which counts in the small difference
/// between arc and chord alone.
constexpr double kEarthRadius_m = 6'371'000.0;

Geodetic below(const render::Eye& eye) noexcept {
    return {eye.latitude_deg, eye.longitude_deg, 0.0};
}

double azimuth_rad(const glm::dvec3& way, const glm::dvec3& east, const glm::dvec3& north) noexcept {
    return std::atan2(glm::dot(way, east), glm::dot(way, north));
}

}  // namespace

GroundArea mix(const GroundArea& from, const GroundArea& to, double t) noexcept {
    if (t <= 0.0 || from == to) return from;
    if (t >= 1.0) return to;
    GroundArea mixed;
    mixed.centre = world::geodetic_of(glm::mix(world::ecef_of(from.centre), world::ecef_of(to.centre), t));
    const double turn_rad = std::remainder(to.rotation_rad - from.rotation_rad, 2.0 * std::numbers::pi);
    mixed.rotation_rad = from.rotation_rad + t * turn_rad;
    mixed.half_size_m = glm::mix(from.half_size_m, to.half_size_m, t);
    mixed.corner_radius_m = std::lerp(from.corner_radius_m, to.corner_radius_m, t);
    mixed.perimeter_m = std::lerp(from.perimeter_m, to.perimeter_m, t);
    return mixed;
}

EyePlane::EyePlane(const render::Eye& eye) noexcept
    : ecef_m_(world::ecef_of(below(eye))),
      east_(world::ecef_from_enu(below(eye), {1.0, 0.0, 0.0})),
      north_(world::ecef_from_enu(below(eye), {0.0, 1.0, 0.0})) {}

render::WeatherArea EyePlane::place(const GroundArea& area) const noexcept {
    render::WeatherArea placed;
    placed.half_size_m = area.half_size_m;
    placed.corner_radius_m = area.corner_radius_m;
    placed.perimeter_m = area.perimeter_m;
    const Geodetic centre{area.centre.latitude_deg, area.centre.longitude_deg, 0.0};
    const glm::dvec3 there_east = world::ecef_from_enu(centre, {1.0, 0.0, 0.0});
    const glm::dvec3 there_north = world::ecef_from_enu(centre, {0.0, 1.0, 0.0});
    const glm::dvec3 way = world::ecef_of(centre) - ecef_m_;
    const double chord_m = glm::length(way);
    // Nearer than that its direction is noise: north there is turned against north here alone.
    if (chord_m < 1e-3) {
        placed.axis_rad = area.rotation_rad + azimuth_rad(there_north, east_, north_);
        return placed;
    }
    const double out_rad = azimuth_rad(way, east_, north_);
    const double in_rad = azimuth_rad(way, there_east, there_north);
    const double arc_m = 2.0 * kEarthRadius_m * std::asin(std::min(chord_m / (2.0 * kEarthRadius_m), 1.0));
    placed.centre_m = arc_m * glm::dvec2{std::sin(out_rad), std::cos(out_rad)};
    placed.axis_rad = area.rotation_rad + out_rad - in_rad;
    return placed;
}

}  // namespace skyig::server::weather
