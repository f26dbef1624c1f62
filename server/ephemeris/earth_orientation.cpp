#include "server/ephemeris/earth_orientation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>

namespace skyig::server::ephemeris {
namespace {

constexpr double kSecondsPerDay = 86400.0;
constexpr double kRadPerArcsec = std::numbers::pi / (180.0 * 3600.0);
constexpr double kFirstLeapSecondMjd = 41317.0;
/// Over so many days the file gives way to the tables.
constexpr double kRamp_days = 1.0;

/// A file's day and its part as a clock time. Its days lie within what a clock can show.
UtcClockTime clock_at(double mjd) noexcept {
    constexpr double kUnixEpochMjd = 40587.0;
    const double day = std::floor(mjd);
    UtcClockTime time = UtcClockTime::from_unix(static_cast<std::int64_t>(day - kUnixEpochMjd) *
                                                static_cast<std::int64_t>(kSecondsPerDay));
    time.advance((mjd - day) * kSecondsPerDay);
    return time;
}

double tt_mjd_of(const UtcClockTime& utc, const KnownOffsets& known) noexcept {
    return utc.mjd() + (utc.second_of_day() + known.tt_minus_utc_s) / kSecondsPerDay;
}

/// 1 from `first` to `last`, 0 from a ramp's length away.
double weight_of(double day, double first, double last) noexcept {
    const double outside = std::max({first - day, day - last, 0.0});
    return std::max(0.0, 1.0 - outside / kRamp_days);
}

}  // namespace

EarthOrientation::EarthOrientation(const std::vector<EarthOrientationRow>& rows) {
    if (rows.size() < 2) return;
    days_.reserve(rows.size());
    for (const EarthOrientationRow& row : rows) {
        const KnownOffsets known = known_offsets(clock_at(row.mjd));
        days_.push_back({.tt_mjd = row.mjd + known.tt_minus_utc_s / kSecondsPerDay,
                         .ut1_minus_tt_s = row.ut1_minus_utc_s - known.tt_minus_utc_s,
                         .x_rad = row.x_arcsec * kRadPerArcsec,
                         .y_rad = row.y_arcsec * kRadPerArcsec});
        if (row.mjd < kFirstLeapSecondMjd) continue;
        correction_at_last_s_ = row.ut1_minus_utc_s - known.ut1_minus_utc_s;
        if (ut1_from_tt_mjd_ < days_.back().tt_mjd) continue;
        ut1_from_tt_mjd_ = days_.back().tt_mjd;
        correction_at_first_s_ = correction_at_last_s_;
    }
    first_mjd_ = rows.front().mjd;
    last_mjd_ = rows.back().mjd;
}

EarthOrientation::Day EarthOrientation::between(double tt_mjd) const noexcept {
    const auto after = std::upper_bound(std::next(days_.begin()), std::prev(days_.end()), tt_mjd,
                                        [](double wanted, const Day& day) { return wanted < day.tt_mjd; });
    const Day& from = *std::prev(after);
    const Day& to = *after;
    const double part = std::clamp((tt_mjd - from.tt_mjd) / (to.tt_mjd - from.tt_mjd), 0.0, 1.0);
    return {.tt_mjd = tt_mjd,
            .ut1_minus_tt_s = std::lerp(from.ut1_minus_tt_s, to.ut1_minus_tt_s, part),
            .x_rad = std::lerp(from.x_rad, to.x_rad, part),
            .y_rad = std::lerp(from.y_rad, to.y_rad, part)};
}

TimeOffsets EarthOrientation::at(const UtcClockTime& utc) const noexcept {
    return days_.empty() ? TimeOffsets{} : at(utc, known_offsets(utc));
}

TimeOffsets EarthOrientation::at(const UtcClockTime& utc, const KnownOffsets& known) const noexcept {
    TimeOffsets offsets;
    if (days_.empty()) return offsets;
    const double now = tt_mjd_of(utc, known);
    const double last = days_.back().tt_mjd;
    const double pole_weight = weight_of(now, days_.front().tt_mjd, last);
    if (pole_weight <= 0.0) return offsets;
    const Day day = between(now);
    offsets.polar_x_rad = pole_weight * day.x_rad;
    offsets.polar_y_rad = pole_weight * day.y_rad;

    const double ut1_weight = weight_of(now, ut1_from_tt_mjd_, last);
    if (ut1_weight >= 1.0) {
        offsets.ut1_minus_utc_s = day.ut1_minus_tt_s + known.tt_minus_utc_s;
    } else if (ut1_weight > 0.0) {
        const double correction_s = now < ut1_from_tt_mjd_ ? correction_at_first_s_ : correction_at_last_s_;
        offsets.ut1_minus_utc_s = known.ut1_minus_utc_s + ut1_weight * correction_s;
    }
    return offsets;
}

}  // namespace skyig::server::ephemeris
