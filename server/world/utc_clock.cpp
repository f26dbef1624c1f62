#include "server/world/utc_clock.h"

#include <optional>

#include "protocol/cigi/validate.h"

namespace skyig::server::world {
namespace {

/// A host that has said the same within so long while the clock ran says it always.
constexpr double kRepeatsWithin_s = 5.0;

std::optional<ephemeris::UtcClockTime> time_of(
    const protocol::cigi::CelestialSphereControl& control) noexcept {
    protocol::cigi::Date date;
    if (!protocol::cigi::parse_date(control.date, date)) return std::nullopt;
    ephemeris::CivilTime civil;
    civil.year = date.year;
    civil.month = date.month;
    civil.day = date.day;
    civil.hour = control.hour;
    civil.minute = control.minute;
    civil.second = static_cast<double>(control.seconds);
    return ephemeris::UtcClockTime::from_civil(civil);
}

}  // namespace

bool UtcClock::apply(const protocol::cigi::CelestialSphereControl& control) noexcept {
    const bool ran = running_;
    running_ = control.ephemeris_enable;
    // CIGI knows no other.
    rate_ = 1.0;
    if (!control.date_time_valid) {
        last_setting_.reset();
        repeats_ = false;
        return true;
    }
    const std::optional<ephemeris::UtcClockTime> setting = time_of(control);
    if (!setting) return false;
    const bool same = setting == last_setting_;
    if (same && ran && silent_s_ <= kRepeatsWithin_s) repeats_ = true;
    silent_s_ = 0.0;
    last_setting_ = setting;
    if (!(same && ((ran && running_) || repeats_))) now_ = *setting;
    return true;
}

void UtcClock::advance(double step_s) noexcept {
    if (!running_) return;
    now_.advance(rate_ * step_s);
    silent_s_ += step_s;
    if (silent_s_ > kRepeatsWithin_s) repeats_ = false;
}

}  // namespace skyig::server::world
