// The world's UTC clock: set by the host, running by itself or frozen.
#pragma once

#include <optional>

#include "protocol/cigi/packets.h"
#include "server/ephemeris/time.h"

namespace skyig::server::world {

class UtcClock {
  public:
    /// \param rate  of its seconds to those that pass, >= 0; 0 is frozen
    UtcClock(const ephemeris::UtcClockTime& start, double rate) noexcept
        : now_(start), running_(rate > 0.0), rate_(running_ ? rate : 1.0) {}
    UtcClock(const ephemeris::UtcClockTime& start, bool running) noexcept
        : UtcClock(start, running ? 1.0 : 0.0) {}

    /// Date, time and `ephemeris_enable` of a Celestial Sphere Control. Hosts exist that repeat the same date
    /// in every message, and CIGI 3.3 has no seconds, so that obeying them would hold the clock at second 0.
    /// So a setting equal to the last one is none while the clock runs on, and for a host that has been
    /// repeating it at least every 5 s of the running clock, none when it freezes, while frozen and when it
    /// resumes either. From any other host the same setting at a freeze is one: its exercise begins anew. A
    /// message without a valid date makes any next setting a new one. \return false when the date and time do
    /// not exist; the clock then stays.
    bool apply(const protocol::cigi::CelestialSphereControl& control) noexcept;

    void advance(double step_s) noexcept;

    /// It is then now; whether it runs stays.
    void stand_at(const ephemeris::UtcClockTime& utc) noexcept { now_ = utc; }

    /// Stops or goes on where it stands.
    void run(bool running) noexcept { running_ = running; }

    [[nodiscard]] const ephemeris::UtcClockTime& utc() const noexcept { return now_; }
    [[nodiscard]] bool running() const noexcept { return running_; }

  private:
    ephemeris::UtcClockTime now_;
    bool running_;
    double rate_;
    std::optional<ephemeris::UtcClockTime> last_setting_;
    /// Since the last valid setting, of the running clock.
    double silent_s_ = 0.0;
    /// The host says its date over and over.
    bool repeats_ = false;
};

}  // namespace skyig::server::world
