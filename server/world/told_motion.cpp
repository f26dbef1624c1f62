#include "server/world/told_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::server::world {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr auto kGround = static_cast<std::size_t>(RateAxes::kGround);
constexpr auto kOwn = static_cast<std::size_t>(RateAxes::kOwn);
constexpr Rates kNone{};

/// Way under a velocity and a constant acceleration.
glm::dvec3 way(const glm::dvec3& velocity, const glm::dvec3& acceleration, double seconds) noexcept {
    return (velocity + acceleration * (0.5 * seconds)) * seconds;
}

glm::dvec3 at_most(const glm::dvec3& value, double most) noexcept {
    const double length = glm::length(value);
    return length > most ? value * (most / length) : value;
}

bool within(const Rates& rates, double most_linear, double most_angular) noexcept {
    return glm::length(rates.linear) <= most_linear && glm::length(rates.angular) <= most_angular;
}

}  // namespace

bool ToldMotion::tell_velocity(RateAxes axes, const Rates& velocity) noexcept {
    if (!within(velocity, kMostSpeed_m_s, kMostTurn_rad_s)) return false;
    velocity_ = {};
    velocity_[static_cast<std::size_t>(axes)] = velocity;
    return true;
}

bool ToldMotion::tell_acceleration(RateAxes axes, const Rates& acceleration) noexcept {
    if (!within(acceleration, kMostAcceleration_m_s2, kMostAngular_rad_s2)) return false;
    acceleration_ = {};
    acceleration_[static_cast<std::size_t>(axes)] = acceleration;
    return true;
}

bool ToldMotion::moves() const noexcept {
    const auto is_none = [](const Rates& rates) { return rates == kNone; };
    return !std::all_of(velocity_.begin(), velocity_.end(), is_none) ||
           !std::all_of(acceleration_.begin(), acceleration_.end(), is_none);
}

ToldMotion ToldMotion::later(double seconds) const noexcept {
    ToldMotion then = *this;
    for (std::size_t axes = 0; axes < velocity_.size(); ++axes) {
        Rates& velocity = then.velocity_[axes];
        velocity.linear = at_most(velocity.linear + acceleration_[axes].linear * seconds, kMostSpeed_m_s);
        velocity.angular = at_most(velocity.angular + acceleration_[axes].angular * seconds, kMostTurn_rad_s);
    }
    return then;
}

glm::dquat ToldMotion::turned(const Pose& from, double seconds) const noexcept {
    const glm::dvec3 angles_deg =
        way(velocity_[kGround].angular, acceleration_[kGround].angular, seconds) * kDegPerRad;
    return ned_from_body(from.yaw_deg + angles_deg.z, from.pitch_deg + angles_deg.y,
                         from.roll_deg + angles_deg.x) *
           turn_by(way(velocity_[kOwn].angular, acceleration_[kOwn].angular, seconds));
}

glm::dvec3 ToldMotion::own_way_ned_m(const Pose& from, double seconds) const noexcept {
    const Rates& velocity = velocity_[kOwn];
    const Rates& acceleration = acceleration_[kOwn];
    if (velocity.linear == glm::dvec3{0.0} && acceleration.linear == glm::dvec3{0.0}) return glm::dvec3{0.0};
    double turn_rad = 0.0;
    for (std::size_t axes = 0; axes < velocity_.size(); ++axes) {
        turn_rad += (glm::length(velocity_[axes].angular) +
                     0.5 * glm::length(acceleration_[axes].angular) * seconds) *
                    seconds;
    }
    constexpr double kPanel_rad = 0.5;
    constexpr double kMostPanels = 400.0;
    const int panels = static_cast<int>(std::clamp(std::ceil(turn_rad / kPanel_rad), 1.0, kMostPanels));
    const double half_s = 0.5 * seconds / panels;
    constexpr double kNode = 0.774596669241483377;  // sqrt(3/5)
    glm::dvec3 sum{0.0};
    for (int panel = 0; panel < panels; ++panel) {
        const double middle_s = half_s * (2 * panel + 1);
        for (const int side : {-1, 0, 1}) {
            const double at_s = middle_s + side * kNode * half_s;
            const double weight = (side == 0 ? 8.0 : 5.0) / 9.0 * half_s;
            sum += turned(from, at_s) * (velocity.linear + acceleration.linear * at_s) * weight;
        }
    }
    return sum;
}

Pose ToldMotion::after(const Pose& from, double seconds) const noexcept {
    const glm::dvec3 own_m = own_way_ned_m(from, seconds);
    const glm::dvec3 ground_m = way(velocity_[kGround].linear, acceleration_[kGround].linear, seconds);
    const GroundStep step = step_over_ground(from.position, own_m + ground_m);
    Pose pose = from;
    pose.position = step.place;
    const auto turns = [](const Rates& rates) { return rates.angular != glm::dvec3{0.0}; };
    if (std::any_of(velocity_.begin(), velocity_.end(), turns) ||
        std::any_of(acceleration_.begin(), acceleration_.end(), turns))
        set_attitude(pose, turned(from, seconds));
    // Who flies straight ahead crosses the meridians at changing angles.
    if (own_m != glm::dvec3{0.0}) pose.yaw_deg += step.convergence_deg;
    return pose;
}

}  // namespace skyig::server::world
