#include "server/world/utc_clock.h"

#include <optional>

#include "protocol/cigi/validate.h"

namespace skyig::server::world {
namespace {

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
    if (!control.date_time_valid) return true;
    const std::optional<ephemeris::UtcClockTime> setting = time_of(control);
    if (!setting) return false;
    const bool repeated = has_setting_ && *setting == last_setting_;
    has_setting_ = true;
    last_setting_ = *setting;
    if (!(repeated && ran && running_)) now_ = *setting;
    return true;
}

void UtcClock::advance(double step_s) noexcept {
    if (running_) now_.advance(step_s);
}

}  // namespace skyig::server::world
