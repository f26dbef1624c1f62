#include "server/ephemeris/sky_clockwork.h"

#include <cmath>

namespace skyig::server::ephemeris {
namespace {

constexpr double kSecondsPerDay = 86400.0;
constexpr double kGridOriginJd = 2451545.0;
constexpr double kMostKnots = 1e12;

JulianDate knot_time(std::int64_t index) noexcept {
    return {kGridOriginJd, static_cast<double>(index) * SkyClockwork::kKnotSpacing_s / kSecondsPerDay};
}

}  // namespace

SlowSky SkyClockwork::evaluate_knot(std::int64_t index) noexcept {
    ++evaluations_;
    return evaluate_slow_sky(knot_time(index), model_);
}

void SkyClockwork::use_interval(std::int64_t index) noexcept {
    if (filled_ && index == index_) return;
    if (filled_ && index == index_ + 1) {
        from_ = to_;
        to_ = evaluate_knot(index + 1);
    } else if (filled_ && index == index_ - 1) {
        to_ = from_;
        from_ = evaluate_knot(index);
    } else {
        from_ = evaluate_knot(index);
        to_ = evaluate_knot(index + 1);
    }
    index_ = index;
    filled_ = true;
}

SkyState SkyClockwork::state(const Instant& instant, const Geodetic& eye) noexcept {
    // The whole days first: their difference is exact, so the place within the interval keeps nanoseconds.
    const double knots_a_day = kSecondsPerDay / kKnotSpacing_s;
    const double place = (instant.tt.day - kGridOriginJd) * knots_a_day + instant.tt.fraction * knots_a_day;
    // Only a hand-made instant is that far off; no interval has a number there.
    if (!(std::abs(place) < kMostKnots)) return compute_sky_state(Instant{}, eye, model_);
    const double knot = std::floor(place);
    use_interval(static_cast<std::int64_t>(knot));
    return sky_state_from(interpolate(from_, to_, place - knot), instant, eye);
}

}  // namespace skyig::server::ephemeris
