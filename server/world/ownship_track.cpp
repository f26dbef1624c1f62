#include "server/world/ownship_track.h"

#include <algorithm>
#include <cmath>

namespace skyig::server::world {
namespace {

constexpr double kSecondsPerTick = 1e-5;
/// Two reports further apart than this in time, faster than any orbit or than any craft turns, are a
/// reposition: no motion is read from them.
constexpr double kLongestGap_s = 1.0;
constexpr double kFastest_m_s = 12'000.0;
constexpr double kFastestTurn_rad_s = 15.0;
/// How far the least delay may grow in a second: a sender's clock that runs slow by 200 ppm is followed.
constexpr double kOffsetDrift = 2e-4;
/// A delay that grows by more than this at once is a sender that began anew.
constexpr double kOffsetJump_s = 2.0;
/// Told motion begins anew after this: what it integrates stays short.
constexpr double kLongestTold_s = 10.0;

}  // namespace

double StampClock::seconds(std::uint32_t ticks) noexcept {
    if (!started_) {
        started_ = true;
        ticks_ = 0;
    } else {
        ticks_ += static_cast<std::int32_t>(ticks - last_);
    }
    last_ = ticks;
    return static_cast<double>(ticks_) * kSecondsPerTick;
}

bool SenderOffset::learn(double arrival_s, double sender_s) noexcept {
    const double delay_s = arrival_s - sender_s;
    const double since_s = std::max(arrival_s - last_arrival_s_, 0.0);
    last_arrival_s_ = arrival_s;
    if (!offset_s_ || std::abs(delay_s - *offset_s_) > kOffsetJump_s) {
        offset_s_ = delay_s;
        return false;
    }
    offset_s_ = std::min(*offset_s_ + kOffsetDrift * since_s, delay_s);
    return true;
}

void OwnshipTrack::reset(const Pose& pose) noexcept {
    *this = {};
    stand_at(pose);
}

void OwnshipTrack::stand_at(const Pose& pose) noexcept {
    pose_ = pose;
    ecef_m_ = ecef_of(pose.position);
    ned_from_body_ = ned_from_body(pose.yaw_deg, pose.pitch_deg, pose.roll_deg);
}

void OwnshipTrack::report_position(const ephemeris::Geodetic& position, double arrival_s,
                                   std::optional<double> sender_s) noexcept {
    const glm::dvec3 ecef_m = ecef_of(position);
    const bool goes_on = sender_s && position_offset_.learn(arrival_s, *sender_s);
    if (!sender_s) position_offset_.reset();
    // The motion goes on as it is by now; the place is what is told.
    if (motion_.moves()) begin_anew(told_at_s(arrival_s, sender_s));
    if (velocity_told_s_ && arrival_s - *velocity_told_s_ > kLongest_s) {
        velocity_told_s_.reset();
        velocity_ecef_m_s_.reset();
    }
    if (!velocity_told_s_) {
        if (goes_on && position_sender_s_) {
            learn_velocity(ecef_m, *sender_s - *position_sender_s_);
        } else {
            velocity_ecef_m_s_.reset();
        }
    }
    pose_.position = position;
    ecef_m_ = ecef_m;
    position_s_ = sender_s ? *sender_s + position_offset_.value_s() : arrival_s;
    position_sender_s_ = sender_s;
}

void OwnshipTrack::learn_velocity(const glm::dvec3& ecef_m, double step_s) noexcept {
    // The same instant told twice says nothing new of the motion.
    if (step_s == 0.0) return;
    velocity_ecef_m_s_.reset();
    if (step_s < 0.0 || step_s > kLongestGap_s) return;
    const glm::dvec3 velocity = (ecef_m - ecef_m_) / step_s;
    if (glm::length(velocity) <= kFastest_m_s) velocity_ecef_m_s_ = velocity;
}

void OwnshipTrack::report_velocity(const glm::dvec3& velocity_enu_m_s, double arrival_s) noexcept {
    velocity_told_s_ = arrival_s;
    velocity_ecef_m_s_ = ecef_from_enu(pose_.position, velocity_enu_m_s);
}

void OwnshipTrack::report_attitude(double yaw_deg, double pitch_deg, double roll_deg, double arrival_s,
                                   std::optional<double> sender_s) noexcept {
    const glm::dquat attitude = ned_from_body(yaw_deg, pitch_deg, roll_deg);
    if (!sender_s) {
        attitude_offset_.reset();
        turn_rad_s_ = {};
    } else if (attitude_offset_.learn(arrival_s, *sender_s) && attitude_sender_s_) {
        learn_turn(attitude, *sender_s - *attitude_sender_s_);
    } else {
        turn_rad_s_ = {};
    }
    pose_.yaw_deg = yaw_deg;
    pose_.pitch_deg = pitch_deg;
    pose_.roll_deg = roll_deg;
    ned_from_body_ = attitude;
    attitude_s_ = sender_s ? *sender_s + attitude_offset_.value_s() : arrival_s;
    attitude_sender_s_ = sender_s;
}

void OwnshipTrack::learn_turn(const glm::dquat& attitude, double step_s) noexcept {
    if (step_s == 0.0) return;
    turn_rad_s_ = {};
    if (step_s < 0.0 || step_s > kLongestGap_s) return;
    const glm::dvec3 turn = rotation_vector_rad(glm::conjugate(ned_from_body_) * attitude) / step_s;
    if (glm::length(turn) <= kFastestTurn_rad_s) turn_rad_s_ = turn;
}

double OwnshipTrack::told_at_s(double arrival_s, std::optional<double> sender_s) const noexcept {
    if (!sender_s || !position_offset_.known()) return arrival_s;
    // Only positions teach the offset: between two of them a sender's clock may drift, or begin anew.
    const double told_s = *sender_s + position_offset_.value_s();
    return told_s > arrival_s || told_s < arrival_s - kLongest_s ? arrival_s : told_s;
}

bool OwnshipTrack::tell_velocity(RateAxes axes, const Rates& velocity, double arrival_s,
                                 std::optional<double> sender_s) noexcept {
    ToldMotion told = motion_;
    if (!told.tell_velocity(axes, velocity)) return false;
    // A host that flies by places may say in every message that it tells no rates.
    if (!told.moves() && !motion_.moves()) return true;
    begin_anew(told_at_s(arrival_s, sender_s));
    return motion_.tell_velocity(axes, velocity);
}

bool OwnshipTrack::tell_acceleration(RateAxes axes, const Rates& acceleration, double arrival_s,
                                     std::optional<double> sender_s) noexcept {
    ToldMotion told = motion_;
    if (!told.tell_acceleration(axes, acceleration)) return false;
    if (!told.moves() && !motion_.moves()) return true;
    begin_anew(told_at_s(arrival_s, sender_s));
    return motion_.tell_acceleration(axes, acceleration);
}

void OwnshipTrack::carry_told(bool on, double now_s) noexcept {
    if (on == carried_) return;
    if (motion_.moves()) begin_anew(now_s);
    carried_ = on;
}

void OwnshipTrack::advance(double now_s) noexcept {
    if (motion_.moves() && now_s - position_s_ > kLongestTold_s) begin_anew(now_s);
}

void OwnshipTrack::begin_anew(double at_s) noexcept {
    const double step_s = at_s - position_s_;
    // Told later, of an instant before the last: it holds from the last on.
    if (motion_.moves() && step_s <= 0.0) return;
    stand_at(at(at_s));
    if (carried_ && motion_.moves()) motion_ = motion_.later(step_s);
    velocity_ecef_m_s_.reset();
    velocity_told_s_.reset();
    turn_rad_s_ = {};
    position_sender_s_.reset();
    attitude_sender_s_.reset();
    position_s_ = attitude_s_ = at_s;
}

double OwnshipTrack::ahead_s(double now_s, double reported_s) noexcept {
    return std::clamp(now_s - reported_s, 0.0, kLongest_s);
}

Pose OwnshipTrack::at(double now_s) const noexcept {
    Pose pose = pose_;
    if (motion_.moves()) {
        const double step_s = now_s - position_s_;
        return carried_ && step_s > 0.0 ? motion_.after(pose, step_s) : pose;
    }
    const double moved_s = ahead_s(now_s, position_s_);
    if (velocity_ecef_m_s_ && *velocity_ecef_m_s_ != glm::dvec3{0.0} && moved_s > 0.0)
        pose.position = geodetic_of(ecef_m_ + *velocity_ecef_m_s_ * moved_s);
    const double turned_s = ahead_s(now_s, attitude_s_);
    if (turn_rad_s_ != glm::dvec3{0.0} && turned_s > 0.0)
        set_attitude(pose, ned_from_body_ * turn_by(turn_rad_s_ * turned_s));
    return pose;
}

}  // namespace skyig::server::world
