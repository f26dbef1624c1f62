// Date and time as an instructor asks for them: an instant, whether it runs, and how fast.
#pragma once

#include "protocol/cigi/packets.h"
#include "server/ephemeris/time.h"

namespace skyig::clients::instructor {

/// The fastest that the sky may run: its clock is then set in steps that count as no jump.
inline constexpr double kFastest = 60.0;

struct ClockSetting {
    server::ephemeris::UtcClockTime utc;
    /// When it was that: seconds of the station's own time.
    double at_s = 0.0;
    bool running = true;
    /// 1..kFastest; by itself a daemon's clock runs at 1.
    double speed = 1.0;

    [[nodiscard]] server::ephemeris::UtcClockTime now(double time_s) const noexcept {
        server::ephemeris::UtcClockTime moved = utc;
        if (running) moved.advance((time_s - at_s) * speed);
        return moved;
    }
    /// How often the clock is to be set so that no step reaches 2 s; 0: once.
    [[nodiscard]] double repeat_s() const noexcept { return running && speed > 1.0 ? 1.5 / speed : 0.0; }
};

}  // namespace skyig::clients::instructor
