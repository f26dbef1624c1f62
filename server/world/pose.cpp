#include "server/world/pose.h"

#include <algorithm>
#include <cmath>
#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>
#include <numbers>

namespace skyig::server::world {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// Of the Earth; within 0.4 % of its radii of curvature.
constexpr double kMeanRadius_m = 6'371'000.0;

glm::dmat3 ecef_from_ned(const ephemeris::Geodetic& place) noexcept {
    return {ecef_from_enu(place, {0.0, 1.0, 0.0}), ecef_from_enu(place, {1.0, 0.0, 0.0}),
            ecef_from_enu(place, {0.0, 0.0, -1.0})};
}

}  // namespace

glm::dvec3 ecef_of(const ephemeris::Geodetic& place) noexcept {
    glm::dvec3 ecef;
    GeographicLib::Geocentric::WGS84().Forward(place.latitude_deg, place.longitude_deg, place.height_m,
                                               ecef.x, ecef.y, ecef.z);
    return ecef;
}

ephemeris::Geodetic geodetic_of(const glm::dvec3& ecef) noexcept {
    ephemeris::Geodetic place;
    GeographicLib::Geocentric::WGS84().Reverse(ecef.x, ecef.y, ecef.z, place.latitude_deg,
                                               place.longitude_deg, place.height_m);
    return place;
}

glm::dvec3 ecef_from_enu(const ephemeris::Geodetic& place, const glm::dvec3& enu) noexcept {
    double sin_lat = 0.0;
    double cos_lat = 1.0;
    double sin_lon = 0.0;
    double cos_lon = 1.0;
    GeographicLib::Math::sincosd(place.latitude_deg, sin_lat, cos_lat);
    GeographicLib::Math::sincosd(place.longitude_deg, sin_lon, cos_lon);
    const glm::dvec3 east(-sin_lon, cos_lon, 0.0);
    const glm::dvec3 north(-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat);
    const glm::dvec3 up(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
    return east * enu.x + north * enu.y + up * enu.z;
}

glm::dquat ned_from_body(double yaw_deg, double pitch_deg, double roll_deg) noexcept {
    const double half = 0.5 * kRadPerDeg;
    const glm::dquat yaw(std::cos(yaw_deg * half), 0.0, 0.0, std::sin(yaw_deg * half));
    const glm::dquat pitch(std::cos(pitch_deg * half), 0.0, std::sin(pitch_deg * half), 0.0);
    const glm::dquat roll(std::cos(roll_deg * half), std::sin(roll_deg * half), 0.0, 0.0);
    return yaw * pitch * roll;
}

void set_attitude(Pose& pose, const glm::dquat& turn) noexcept {
    const glm::dquat& q = turn;
    const double sine_pitch = std::clamp(2.0 * (q.w * q.y - q.z * q.x), -1.0, 1.0);
    pose.pitch_deg = std::asin(sine_pitch) / kRadPerDeg;
    if (std::abs(sine_pitch) > 1.0 - 1e-12) {
        // Nose straight up or down: yaw and roll are one turn.
        pose.yaw_deg = 2.0 * std::atan2(q.z, q.w) / kRadPerDeg;
        pose.roll_deg = 0.0;
        return;
    }
    pose.yaw_deg =
        std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z)) / kRadPerDeg;
    pose.roll_deg =
        std::atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y)) / kRadPerDeg;
}

glm::dquat turn_by(const glm::dvec3& rotation_rad) noexcept {
    const double angle = glm::length(rotation_rad);
    const double scale = angle < 1e-12 ? 0.5 : std::sin(0.5 * angle) / angle;
    return {std::cos(0.5 * angle), rotation_rad.x * scale, rotation_rad.y * scale, rotation_rad.z * scale};
}

glm::dvec3 rotation_vector_rad(glm::dquat turn) noexcept {
    if (turn.w < 0.0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    // For a small turn the half angle's sine is the half angle.
    return sine < 1e-12 ? 2.0 * axis : axis * (2.0 * std::atan2(sine, turn.w) / sine);
}

GroundStep step_over_ground(const ephemeris::Geodetic& from, const glm::dvec3& ned_m) noexcept {
    GroundStep step{from};
    const double path_m = std::hypot(ned_m.x, ned_m.y);
    if (path_m > 0.0) {
        const double azimuth_deg = std::atan2(ned_m.y, ned_m.x) / kRadPerDeg;
        const double ground_m = path_m * kMeanRadius_m / (kMeanRadius_m + from.height_m);
        double end_azimuth_deg = azimuth_deg;
        GeographicLib::Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, azimuth_deg, ground_m,
                                                step.place.latitude_deg, step.place.longitude_deg,
                                                end_azimuth_deg);
        step.convergence_deg = std::remainder(end_azimuth_deg - azimuth_deg, 360.0);
    }
    step.place.height_m =
        std::clamp(from.height_m - ned_m.z, ephemeris::kMinEyeHeight_m, ephemeris::kMaxEyeHeight_m);
    return step;
}

Pose pose_on(const Pose& carrier, const glm::dvec3& offset_m, const glm::dquat& body_from_part) noexcept {
    const glm::dquat carrier_turn = ned_from_body(carrier.yaw_deg, carrier.pitch_deg, carrier.roll_deg);
    Pose pose{carrier.position};
    glm::dquat turn = carrier_turn * body_from_part;
    if (offset_m != glm::dvec3{0.0}) {
        const glm::dmat3 ecef_from_carrier_ned = ecef_from_ned(carrier.position);
        pose.position =
            geodetic_of(ecef_of(carrier.position) + ecef_from_carrier_ned * (carrier_turn * offset_m));
        const glm::dmat3 ned_from_carrier_ned =
            glm::transpose(ecef_from_ned(pose.position)) * ecef_from_carrier_ned;
        turn = glm::quat_cast(ned_from_carrier_ned) * turn;
    }
    set_attitude(pose, turn);
    return pose;
}

}  // namespace skyig::server::world
