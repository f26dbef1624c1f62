// The ownship, or another entity, between two reports of its place: carried on by what is told of its motion,
// else by what it did last, then held.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "server/world/pose.h"
#include "server/world/told_motion.h"

namespace skyig::server::world {

/// Seconds of a sender's clock that counts 10 microseconds in 32 bits: differences survive the wrap after
/// 11.9 h either way.
class StampClock {
  public:
    /// \return seconds since the first stamp
    double seconds(std::uint32_t ticks) noexcept;
    void reset() noexcept { started_ = false; }

  private:
    bool started_ = false;
    std::uint32_t last_ = 0;
    std::int64_t ticks_ = 0;
};

/// The world's time less a sender's, at the least delay seen: the network's delay and our frames' raster are
/// taken out, a sender's clock that runs slow is followed.
class SenderOffset {
  public:
    /// \return false when the two times have nothing to do with those before: a sender that began anew.
    bool learn(double arrival_s, double sender_s) noexcept;
    [[nodiscard]] bool known() const noexcept { return offset_s_.has_value(); }
    [[nodiscard]] double value_s() const noexcept { return offset_s_.value_or(0.0); }
    void reset() noexcept { offset_s_.reset(); }

  private:
    std::optional<double> offset_s_;
    double last_arrival_s_ = 0.0;
};

/// Reports come with the world's time of their arrival and, where the sender stamps them, with the sender's
/// own time. Stamped reports are moved along the line (the turn) that the last two make. Reports without
/// stamp stand until the next one, unless a velocity is known. Nothing is carried on for longer than
/// kLongest_s: then it is held. Place and attitude may come together or each by itself.
///
/// Rates that are told (tell_velocity, tell_acceleration) come before all that is read from reports: while
/// any is not zero they alone carry on, from the last report or from where the craft was when they came, for
/// as long as they are not told otherwise; a report moves the craft and leaves the rates. When all are zero
/// again it stands where it is, and successive reports count again.
///
/// Depends on what was reported alone: no clock, no allocation. 1 microsecond a frame.
class OwnshipTrack {
  public:
    static constexpr double kLongest_s = 1.0;

    /// \param arrival_s  the world's time  \param sender_s  of any origin; nothing: held until the next
    void report_position(const ephemeris::Geodetic& position, double arrival_s,
                         std::optional<double> sender_s) noexcept;
    void report_attitude(double yaw_deg, double pitch_deg, double roll_deg, double arrival_s,
                         std::optional<double> sender_s) noexcept;
    /// East, north, up, metres a second: takes the place of what successive positions say, until none has
    /// come for kLongest_s.
    void report_velocity(const glm::dvec3& velocity_enu_m_s, double arrival_s) noexcept;

    /// Hold from the instant that the message's stamp tells, or from its arrival. False, and nothing changed,
    /// when no craft does that (ToldMotion).
    bool tell_velocity(RateAxes axes, const Rates& velocity, double arrival_s,
                       std::optional<double> sender_s) noexcept;
    bool tell_acceleration(RateAxes axes, const Rates& acceleration, double arrival_s,
                           std::optional<double> sender_s) noexcept;
    /// Whether told rates carry on (at first they do not); else the craft stands where it is by then.
    void carry_told(bool on, double now_s) noexcept;
    /// Once a frame; keeps what at() has to compute short.
    void advance(double now_s) noexcept;

    /// The pose at the world's time `now_s`; bit for bit the reported one where nothing is to be carried on.
    [[nodiscard]] Pose at(double now_s) const noexcept;

    /// The pose as it was reported last.
    [[nodiscard]] const Pose& told() const noexcept { return pose_; }

    /// Another sender, or a new start: nothing of before is used but the pose.
    void reset(const Pose& pose) noexcept;

  private:
    void learn_velocity(const glm::dvec3& ecef_m, double step_s) noexcept;
    void learn_turn(const glm::dquat& attitude, double step_s) noexcept;
    [[nodiscard]] static double ahead_s(double now_s, double reported_s) noexcept;
    [[nodiscard]] double told_at_s(double arrival_s, std::optional<double> sender_s) const noexcept;
    /// Makes where the craft is at `at_s` the point from which it goes on; nothing of successive reports
    /// stays.
    void begin_anew(double at_s) noexcept;
    void stand_at(const Pose& pose) noexcept;

    Pose pose_;

    glm::dvec3 ecef_m_{0.0};
    /// Of the last position, by the world's and the sender's clock.
    double position_s_ = 0.0;
    std::optional<double> position_sender_s_;
    SenderOffset position_offset_;
    std::optional<glm::dvec3> velocity_ecef_m_s_;
    /// When it was told, by the world's clock; nothing: it is learned.
    std::optional<double> velocity_told_s_;

    glm::dquat ned_from_body_{1.0, 0.0, 0.0, 0.0};
    double attitude_s_ = 0.0;
    std::optional<double> attitude_sender_s_;
    SenderOffset attitude_offset_;
    /// Turn a second, about body axes, radians.
    glm::dvec3 turn_rad_s_{0.0};

    ToldMotion motion_;
    bool carried_ = false;
};

}  // namespace skyig::server::world
