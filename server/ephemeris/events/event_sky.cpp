#include "server/ephemeris/events/event_sky.h"

#include <cmath>

namespace skyig::server::ephemeris::events {
namespace {

constexpr double kGridOriginJd = 2451545.0;

}  // namespace

EventSky::EventSky(const UtcClockTime& origin, const Geodetic& site, Model model, Knots knots) noexcept
    : origin_(origin), site_(site), model_(model), knots_per_day_(knots == Knots::kHour ? 24.0 : 144.0) {}

UtcClockTime EventSky::time_at(double seconds) const noexcept {
    UtcClockTime time = origin_;
    time.advance(seconds);
    return time;
}

const SlowSky& EventSky::knot(std::int64_t index) noexcept {
    // The offset makes every index positive; it is a multiple of the number of slots.
    Knot& slot = kept_[static_cast<std::size_t>(index + (std::int64_t{1} << 40)) % kKnotCount];
    if (!slot.filled || slot.index != index) {
        slot.sky = evaluate_slow_sky({kGridOriginJd, static_cast<double>(index) / knots_per_day_}, model_);
        slot.index = index;
        slot.filled = true;
    }
    return slot.sky;
}

SkyState EventSky::state_at(double seconds) noexcept {
    const Instant instant = instant_at(seconds);
    const double place =
        (instant.tt.day - kGridOriginJd) * knots_per_day_ + instant.tt.fraction * knots_per_day_;
    const double whole = std::floor(place);
    const auto index = static_cast<std::int64_t>(whole);
    return sky_state_from(interpolate(knot(index), knot(index + 1), place - whole), instant, site_);
}

}  // namespace skyig::server::ephemeris::events
