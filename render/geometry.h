// The few facts of a spherical Earth seen from an eye, and directions as elevation and azimuth.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render {

/// Mean radius of the ground that the air lies on, metres.
inline constexpr double kEarthRadius_m = 6371.0e3;

/// Elevation of the geometric horizon, minus its dip: <= 0. An eye below the ground counts as on it.
[[nodiscard]] double horizon_elevation_rad(double eye_height_m) noexcept;

/// Elevation of the straight ray that leaves the eye instead of the one that air bends: along the level and
/// above it the same, down to the horizon in proportion, below it as the chords of one bend. Both horizons at
/// or below the level.
[[nodiscard]] double straight_elevation_rad(double seen_rad, double seen_horizon_rad,
                                            double straight_horizon_rad) noexcept;

/// Elevation and azimuth (clockwise from north) of a direction; both finite at the poles.
struct Horizontal {
    double elevation_rad = 0.0;
    double azimuth_rad = 0.0;
};
/// \param direction_enu  any length but zero
[[nodiscard]] Horizontal horizontal_of(const glm::dvec3& direction_enu) noexcept;
[[nodiscard]] glm::dvec3 direction_of(const Horizontal& horizontal) noexcept;

/// East-north-up axes from equatorial ones (x to the equinox, z to the north pole) on a sphere.
/// \param sidereal_rad  right ascension of the meridian
[[nodiscard]] glm::dmat3 enu_from_equatorial(double latitude_rad, double sidereal_rad) noexcept;

/// 0 below `low`, 1 above `high`, smooth between; `low` may be above `high` (then it falls).
[[nodiscard]] double smooth_step(double low, double high, double x) noexcept;

}  // namespace skyig::render
