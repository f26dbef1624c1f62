// The sky state once a frame, at the price of a few rotations: the slow series are evaluated at knots only.
#pragma once

#include <cstdint>

#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/slow_sky.h"

namespace skyig::server::ephemeris {

/// Gives what compute_sky_state gives, with the geocentric vectors, the Earth's velocity and the
/// precession-nutation matrix interpolated linearly between knots; Earth rotation, site, parallax, light time
/// and aberration are exact each call. The knots lie on a fixed grid of TT, so that a state depends on its
/// instant and eye alone, never on what was asked before: the clock may run backwards or jump. Allocates
/// nothing. One object a thread.
///
/// Error added: 0.0001 arcsec. Cost within an interval: 0.3 microseconds. The series cost 35 microseconds,
/// twice after a jump and once when time runs on into the next interval.
class SkyClockwork {
  public:
    static constexpr double kKnotSpacing_s = 60.0;

    [[nodiscard]] SkyState state(const Instant& instant, const Geodetic& eye) noexcept;

    /// How often the series have been evaluated since construction (metrics, tests).
    [[nodiscard]] std::uint64_t evaluations() const noexcept { return evaluations_; }

  private:
    void use_interval(std::int64_t index) noexcept;
    [[nodiscard]] SlowSky evaluate_knot(std::int64_t index) noexcept;

    bool filled_ = false;
    std::int64_t index_ = 0;
    SlowSky from_;
    SlowSky to_;
    std::uint64_t evaluations_ = 0;
};

}  // namespace skyig::server::ephemeris
