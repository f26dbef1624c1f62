#include "server/ephemeris/events/event_sky.h"

#include <cmath>

namespace skyig::server::ephemeris::events {
namespace {

constexpr double kGridOriginJd = 2451545.0;
constexpr double kHoursPerDay = 24.0;

}  // namespace

EventSky::EventSky(const UtcClockTime& origin, const Geodetic& site, Model model) noexcept
    : origin_(origin), site_(site), model_(model) {}

UtcClockTime EventSky::time_at(double seconds) const noexcept {
    UtcClockTime time = origin_;
    time.advance(seconds);
    return time;
}

const SlowSky& EventSky::knot(std::int64_t hour) noexcept {
    // As many slots as hours in two and a half days; the hours are far from overflow in either direction.
    Knot& slot = knots_[static_cast<std::size_t>(hour + (std::int64_t{1} << 40)) % kKnotCount];
    if (!slot.filled || slot.hour != hour) {
        slot.sky = evaluate_slow_sky({kGridOriginJd, static_cast<double>(hour) / kHoursPerDay}, model_);
        slot.hour = hour;
        slot.filled = true;
    }
    return slot.sky;
}

SkyState EventSky::state_at(double seconds) noexcept {
    const Instant instant = instant_at(seconds);
    const double hours = (instant.tt.day - kGridOriginJd) * kHoursPerDay + instant.tt.fraction * kHoursPerDay;
    const double hour = std::floor(hours);
    const auto index = static_cast<std::int64_t>(hour);
    return sky_state_from(interpolate(knot(index), knot(index + 1), hours - hour), instant, site_);
}

}  // namespace skyig::server::ephemeris::events
