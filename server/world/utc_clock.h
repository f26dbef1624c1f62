// The world's UTC clock: set by the host, running by itself or frozen.
#pragma once

#include "protocol/cigi/packets.h"
#include "server/ephemeris/time.h"

namespace skyig::server::world {

class UtcClock {
  public:
    UtcClock(const ephemeris::UtcClockTime& start, bool running) noexcept : now_(start), running_(running) {}

    /// Date, time and `ephemeris_enable` of a Celestial Sphere Control. A setting equal to the last one is
    /// none while the clock ran and goes on running: hosts exist that repeat the minute in every message, and
    /// CIGI 3.3 has no seconds, so that obeying them would hold the clock at second 0. \return false when the
    /// date and time do not exist; the clock then stays.
    bool apply(const protocol::cigi::CelestialSphereControl& control) noexcept;

    void advance(double step_s) noexcept;

    [[nodiscard]] const ephemeris::UtcClockTime& utc() const noexcept { return now_; }
    [[nodiscard]] bool running() const noexcept { return running_; }

  private:
    ephemeris::UtcClockTime now_;
    bool running_;
    bool has_setting_ = false;
    ephemeris::UtcClockTime last_setting_;
};

}  // namespace skyig::server::world
