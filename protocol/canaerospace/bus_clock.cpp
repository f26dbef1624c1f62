#include "protocol/canaerospace/bus_clock.h"

#include <algorithm>
#include <cmath>

#include "protocol/canaerospace/sequence.h"

namespace skyig::protocol::canaerospace {
namespace {

constexpr double kDay_s = 86'400.0;
constexpr double kJulianDate1970 = 2'440'587.5;
// What a 64-bit Julian date of today can tell.
constexpr double kJulianStep_s = 1e-4;
// Larger differences are somebody's wish and not drift.
constexpr double kLargestSlew_s = 2.0;
// Seconds a second: with 1, the clock stands still while it is ahead, but never turns back.
constexpr double kSlewRate = 1.0;
// So far apart time and date may have been sent around midnight.
constexpr double kMidnightSkew_s = 60.0;
constexpr double kHalfDay_s = 43'200.0;
// A date that time does not bear out is believed after it was repeated for so long.
constexpr std::int64_t kDatePatience_ns = 10'000'000'000;

/// The smallest change that brings `error_s` (of a value that stands for [value, value + step)) to nothing.
double needed_change(double error_s, double step_s) noexcept {
    if (error_s > 0.0) return error_s;
    return error_s + step_s <= 0.0 ? error_s + step_s : 0.0;
}

}  // namespace

BusClock::State BusClock::run_to(std::int64_t now_ns) const noexcept {
    State state = state_;
    const double dt_s = static_cast<double>(elapsed_ns(state_.at_ns, now_ns)) * 1e-9;
    const double slew_s = std::clamp(state.slew_s, -kSlewRate * dt_s, kSlewRate * dt_s);
    state.at_ns = std::max(state_.at_ns, now_ns);
    state.slew_s -= slew_s;
    state.second += rate_ * dt_s + slew_s;
    if (state.second >= kDay_s || state.second < 0.0) {
        const double days = std::floor(state.second / kDay_s);
        state.day += static_cast<std::int64_t>(days);
        state.second = std::clamp(state.second - days * kDay_s, 0.0, std::nextafter(kDay_s, 0.0));
        state.leap = false;
    }
    return state;
}

void BusClock::step_to(std::int64_t day, double second_of_day) noexcept {
    state_.day = day;
    state_.leap = second_of_day >= kDay_s;
    state_.second = state_.leap ? second_of_day - 1.0 : second_of_day;
    state_.slew_s = 0.0;
    ++steps_;
}

bool BusClock::enter_leap_second() noexcept {
    if (state_.second >= kDay_s - kLargestSlew_s) {
        state_.second -= 1.0;
    } else if (state_.second <= kLargestSlew_s) {  // midnight is already past
        state_.day -= 1;
        state_.second = kDay_s - 1.0 + std::min(state_.second, 0.999);
    } else {
        return false;
    }
    state_.leap = true;
    return true;
}

void BusClock::set_time_of_day(double second_of_day, double step_s, std::int64_t received_ns) noexcept {
    if (!has_time_) {
        has_time_ = true;
        state_.at_ns = received_ns;
        step_to(has_date_ ? sent_date_ : 0, second_of_day);
        return;
    }
    state_ = run_to(received_ns);
    const std::int64_t day = has_date_ ? sent_date_ : state_.day;
    if (second_of_day >= kDay_s && !state_.leap && !enter_leap_second()) {
        step_to(day, second_of_day);
        return;
    }
    const double length_s = state_.leap ? kDay_s + 1.0 : kDay_s;
    double error_s = second_of_day - state_.shown_second();
    if (error_s > kHalfDay_s) error_s -= length_s;
    if (error_s < -kHalfDay_s) error_s += length_s;
    const double change_s = needed_change(error_s, step_s);
    if (std::abs(change_s) <= kLargestSlew_s) {
        state_.slew_s = change_s;
    } else {
        step_to(day, second_of_day);
    }
}

bool BusClock::is_far_from_midnight() const noexcept {
    return state_.second >= kMidnightSkew_s && state_.second <= kDay_s - kMidnightSkew_s;
}

double BusClock::distance_s(std::int64_t day) const noexcept {
    const double start_s = static_cast<double>(day - state_.day) * kDay_s - state_.second;
    return std::max({0.0, start_s, -(start_s + kDay_s)});
}

void BusClock::set_date(std::int64_t day, std::int64_t received_ns) noexcept {
    const bool first = !has_date_;
    const bool changed = first || day != sent_date_;
    has_date_ = true;
    sent_date_ = day;
    if (changed) agreed_ = date_waits_ = false;
    if (!has_time_) return;
    state_ = run_to(received_ns);
    const double distance = distance_s(day);
    if (!first && distance <= kMidnightSkew_s) {
        if (state_.day == day && is_far_from_midnight()) agreed_ = true;
        date_waits_ = false;
        return;
    }
    if (agreed_) return;
    if (!first && distance <= kHalfDay_s) {
        if (!date_waits_) date_waits_since_ns_ = received_ns;
        date_waits_ = true;
        if (elapsed_ns(date_waits_since_ns_, received_ns) < kDatePatience_ns) return;
    }
    date_waits_ = false;
    state_.day = day;
    agreed_ = is_far_from_midnight();
    ++steps_;
}

void BusClock::set_julian_date(double julian_date, std::int64_t received_ns) noexcept {
    const double days = julian_date - kJulianDate1970;
    const double whole_days = std::floor(days);
    const auto day = static_cast<std::int64_t>(whole_days);
    const double second = (days - whole_days) * kDay_s;
    const bool known = has_time_ && has_date_;
    state_ = run_to(received_ns);
    state_.at_ns = has_time_ ? state_.at_ns : received_ns;
    has_time_ = has_date_ = true;
    sent_date_ = day;
    date_waits_ = false;
    const double error_s = static_cast<double>(day - state_.day) * kDay_s + second - state_.second;
    const double change_s = needed_change(error_s, kJulianStep_s);
    if (known && std::abs(change_s) <= kLargestSlew_s) {
        state_.slew_s = change_s;
    } else {
        step_to(day, second);
    }
    agreed_ = is_far_from_midnight();
}

void BusClock::set_rate(double rate, std::int64_t received_ns) noexcept {
    if (has_time_) state_ = run_to(received_ns);
    rate_ = rate;
}

std::optional<BusTime> BusClock::at(std::int64_t now_ns) const noexcept {
    if (!has_time_ || !has_date_) return std::nullopt;
    const State state = run_to(now_ns);
    return BusTime{state.day, state.shown_second()};
}

}  // namespace skyig::protocol::canaerospace
