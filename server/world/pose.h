// Place and attitude of what carries an eye, and of what is fixed to it.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "server/ephemeris/sky_state.h"

namespace skyig::server::world {

/// Place and attitude: about Z, then Y, then X of north-east-down axes; clockwise from true north, nose up,
/// right wing down.
struct Pose {
    ephemeris::Geodetic position;
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;

    friend bool operator==(const Pose&, const Pose&) = default;
};

/// Earth-centred, Earth-fixed metres (WGS84).
[[nodiscard]] glm::dvec3 ecef_of(const ephemeris::Geodetic& place) noexcept;
[[nodiscard]] ephemeris::Geodetic geodetic_of(const glm::dvec3& ecef_m) noexcept;
/// At a pole, east and north are those along the meridian `place.longitude_deg`.
[[nodiscard]] glm::dvec3 ecef_from_enu(const ephemeris::Geodetic& place, const glm::dvec3& enu) noexcept;

/// Turns the axes of something yawed, then pitched, then rolled into those of what it is turned against.
[[nodiscard]] glm::dquat ned_from_body(double yaw_deg, double pitch_deg, double roll_deg) noexcept;
/// The angles of such a turn: yaw and roll -180..180, pitch -90..90. With the nose straight up or down, yaw
/// and roll are one turn: all of it is yaw.
void set_attitude(Pose& pose, const glm::dquat& turn) noexcept;

/// Turn by |rotation_rad| about the direction of `rotation_rad`.
[[nodiscard]] glm::dquat turn_by(const glm::dvec3& rotation_rad) noexcept;
/// The inverse, the shorter way round.
[[nodiscard]] glm::dvec3 rotation_vector_rad(glm::dquat turn) noexcept;

/// A place reached over the ground, and how far north has turned on the way.
struct GroundStep {
    ephemeris::Geodetic place;
    /// Azimuth of the path at its end less that at its start.
    double convergence_deg = 0.0;
};

/// Along the geodesic that sets out by `ned_m`, its length that of the path at the height of `from`; the
/// height changes by the third part alone, held within what can be drawn. Poles are no obstacle.
[[nodiscard]] GroundStep step_over_ground(const ephemeris::Geodetic& from, const glm::dvec3& ned_m) noexcept;

/// Where something is that stands at `offset_m` along the carrier's axes (forward, right, down), turned by
/// `body_from_part`. Its angles are against north-east-down at its own place; without offset its place is the
/// carrier's to the last bit.
[[nodiscard]] Pose pose_on(const Pose& carrier, const glm::dvec3& offset_m,
                           const glm::dquat& body_from_part) noexcept;

}  // namespace skyig::server::world
