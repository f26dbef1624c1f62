// Motion as a host tells it (Rate Control, Velocity Control, Acceleration Control), carried on by itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "server/world/pose.h"

namespace skyig::server::world {

/// A velocity (m/s, rad/s) or an acceleration (m/s2, rad/s2).
struct Rates {
    /// Forward, right, down; or north, east, down.
    glm::dvec3 linear{0.0};
    /// Roll, pitch, yaw.
    glm::dvec3 angular{0.0};

    friend bool operator==(const Rates&, const Rates&) = default;
};

enum class RateAxes : std::uint8_t {
    /// North, east, down at each place on the way, so that level flight stays level; the angular part is that
    /// of the angles roll, pitch and yaw themselves.
    kGround,
    /// The craft's own, which turn with it; the angular part is about them.
    kOwn,
};

/// Velocities in both kinds of axes add up, and so do accelerations. The craft turns by the integral of its
/// angular velocity, which is exact while acceleration and velocity turn about one axis; its way is
/// integrated along that turn (Gauss-Legendre, three points in half a radian: error under 1e-7 of the way).
class ToldMotion {
  public:
    /// What no craft does is refused: beyond these a packet is a mistake.
    static constexpr double kMostSpeed_m_s = 12'000.0;
    static constexpr double kMostTurn_rad_s = 15.0;
    static constexpr double kMostAcceleration_m_s2 = 1'000.0;
    static constexpr double kMostAngular_rad_s2 = 100.0;

    /// Takes the place of all velocity told before, in either axes. False, and nothing changed, when it is
    /// beyond the above. All zero: the craft stands, but what accelerates it stays.
    bool tell_velocity(RateAxes axes, const Rates& velocity) noexcept;
    /// The same for acceleration; the velocity stays.
    bool tell_acceleration(RateAxes axes, const Rates& acceleration) noexcept;

    friend bool operator==(const ToldMotion&, const ToldMotion&) = default;

    [[nodiscard]] bool moves() const noexcept;
    /// Where the craft is after `seconds` >= 0. Meant for steps of seconds, not of hours: what is told along
    /// the ground is a geodesic for one step.
    [[nodiscard]] Pose after(const Pose& from, double seconds) const noexcept;
    /// The motion as it is then; velocities stay within the above.
    [[nodiscard]] ToldMotion later(double seconds) const noexcept;

  private:
    [[nodiscard]] glm::dquat turned(const Pose& from, double seconds) const noexcept;
    [[nodiscard]] glm::dvec3 own_way_ned_m(const Pose& from, double seconds) const noexcept;

    /// By RateAxes.
    std::array<Rates, 2> velocity_{};
    std::array<Rates, 2> acceleration_{};
};

}  // namespace skyig::server::world
