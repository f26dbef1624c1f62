// Angles between and of directions, the way the whole ephemeris measures them: without acos, without poles.
#pragma once

#include <glm/glm.hpp>

namespace skyig::server::ephemeris {

/// Angle between two directions of any length, 0..pi, exact to rounding also near 0 and pi.
[[nodiscard]] double angle_between_rad(const glm::dvec3& a, const glm::dvec3& b) noexcept;

/// Part of the area of a disc that another covers, 0..1: lens area of two circles in the plane (fit for radii
/// under a degree). Radii >= 0 (a disc of radius 0 is covered or not), separation >= 0, one unit for all
/// three.
[[nodiscard]] double covered_fraction(double radius, double covering_radius, double separation) noexcept;

/// The same direction within 0 <= angle < 2 pi, of an angle in -2 pi .. 2 pi; what rounding would lift to a
/// whole turn is 0.
[[nodiscard]] double turn_from_zero(double angle_rad) noexcept;

struct Equatorial {
    /// 0 <= right ascension < 2 pi; 0 at a pole.
    double right_ascension_rad = 0.0;
    double declination_rad = 0.0;
};

struct Horizontal {
    /// North 0, east pi / 2, 0 <= azimuth < 2 pi; 0 at the zenith and the nadir.
    double azimuth_rad = 0.0;
    double elevation_rad = 0.0;
};

/// Of a direction of any length in equatorial axes (x to the origin of right ascension, z to the pole).
[[nodiscard]] Equatorial equatorial_of(const glm::dvec3& direction) noexcept;

/// Of a direction of any length, east-north-up.
[[nodiscard]] Horizontal horizontal_of(const glm::dvec3& direction_enu) noexcept;

/// Position angle at `direction` of what lies towards `towards`, from `pole` through east, -pi..pi; finite
/// always, without meaning where `direction` is the pole or `towards` is along it. One set of axes for all.
[[nodiscard]] double position_angle_rad(const glm::dvec3& direction, const glm::dvec3& towards,
                                        const glm::dvec3& pole) noexcept;

}  // namespace skyig::server::ephemeris
