#include "server/ephemeris/time.h"

#include <erfa.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "server/ephemeris/delta_t.h"

namespace skyig::server::ephemeris {
namespace {

constexpr double kSecondsPerDay = 86400.0;
constexpr double kJulianDateOfMjdZero = 2400000.5;
constexpr double kJ2000 = 2451545.0;
constexpr double kTtMinusTai_s = 32.184;

constexpr std::int32_t kUnixEpochMjd = 40587;
constexpr std::int32_t kFirstLeapSecondMjd = 41317;  // 1972-01-01: UTC in whole seconds from TAI
constexpr std::int32_t kFirstMjd = -678575;          // 0001-01-01
constexpr std::int32_t kLastMjd = 2973483;           // 9999-12-31
constexpr std::int32_t kFirstSkyMjd = 15020;         // 1900-01-01
constexpr std::int32_t kLastSkyMjd = 88433;          // 2100-12-31

struct Date {
    int year = 0;
    int month = 0;
    int day = 0;
};

Date date_of(std::int32_t mjd) noexcept {
    Date date;
    double fraction = 0.0;
    eraJd2cal(kJulianDateOfMjdZero, static_cast<double>(mjd), &date.year, &date.month, &date.day, &fraction);
    return date;
}

struct TaiOffset {
    double tai_minus_utc_s = 0.0;
    bool assumed = false;
};

/// From 1972 on; before that ERFA has drift rates and then nothing, which is not what is wanted there.
TaiOffset tai_offset(std::int32_t mjd) noexcept {
    const Date date = date_of(mjd);
    TaiOffset offset;
    const int status = eraDat(date.year, date.month, date.day, 0.0, &offset.tai_minus_utc_s);
    offset.assumed = status != 0;
    return offset;
}

double leap_seconds_before(std::int32_t mjd) noexcept {
    constexpr double kTaiMinusUtcAtStart_s = 10.0;
    return mjd < kFirstLeapSecondMjd ? 0.0 : tai_offset(mjd).tai_minus_utc_s - kTaiMinusUtcAtStart_s;
}

double length_of_day_s(std::int32_t mjd) noexcept {
    return kSecondsPerDay + leap_seconds_before(mjd + 1) - leap_seconds_before(mjd);
}

std::optional<std::int32_t> mjd_of(int year, int month, int day) noexcept {
    double mjd_zero = 0.0;
    double mjd = 0.0;
    if (year < 1 || year > 9999 || eraCal2jd(year, month, day, &mjd_zero, &mjd) != 0) return std::nullopt;
    return static_cast<std::int32_t>(mjd);
}

/// Reads exactly `digits` decimal digits from the front of `text`.
bool take_number(std::string_view& text, std::size_t digits, int& value) noexcept {
    if (text.size() < digits) return false;
    const char* const end = text.data() + digits;
    const std::from_chars_result result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc{} || result.ptr != end || value < 0) return false;
    text.remove_prefix(digits);
    return true;
}

bool take_one_of(std::string_view& text, std::string_view characters) noexcept {
    if (text.empty() || characters.find(text.front()) == std::string_view::npos) return false;
    text.remove_prefix(1);
    return true;
}

/// Reads ".25" from the front of `text`; a dot without a digit behind it is refused.
bool take_fraction(std::string_view& text, double& value) noexcept {
    constexpr double kBase = 10.0;
    std::size_t digits = 0;
    double scale = 1.0;
    text.remove_prefix(1);
    for (; digits < text.size() && text[digits] >= '0' && text[digits] <= '9'; ++digits) {
        scale /= kBase;
        value += scale * static_cast<double>(text[digits] - '0');
    }
    text.remove_prefix(digits);
    return digits > 0;
}

bool take_seconds(std::string_view& text, double& second) noexcept {
    int whole = 0;
    if (!take_number(text, 2, whole)) return false;
    double fraction = 0.0;
    if (!text.empty() && text.front() == '.' && !take_fraction(text, fraction)) return false;
    // Digits beyond the resolution of a double may add up to the next second, which the text does not mean.
    second = std::min(static_cast<double>(whole) + fraction, std::nextafter(whole + 1.0, 0.0));
    return true;
}

/// A moment of the two centuries that the sky is made for.
struct ClampedUtc {
    std::int32_t mjd = 0;
    double second = 0.0;
    bool outside = false;
};

ClampedUtc clamped(const UtcClockTime& utc) noexcept {
    if (utc.mjd() < kFirstSkyMjd) return {kFirstSkyMjd, 0.0, true};
    if (utc.mjd() > kLastSkyMjd) return {kLastSkyMjd, kSecondsPerDay, true};
    return {utc.mjd(), utc.second_of_day(), false};
}

/// By TT, since UTC's seconds of the day start again after a leap second.
double delta_t_at(std::int32_t mjd, double tt_second) noexcept {
    constexpr double kMjdOf2000 = 51544.0;
    constexpr double kDaysPerYear = 365.25;
    return delta_t_s(2000.0 + (mjd - kMjdOf2000 + tt_second / kSecondsPerDay) / kDaysPerYear);
}

/// Before 1972.
KnownOffsets offsets_by_ut1(const ClampedUtc& moment) noexcept {
    constexpr double kTtMinusUtcIn1972_s = 10.0 + kTtMinusTai_s;
    constexpr std::int32_t kRampMjd = kFirstLeapSecondMjd - 365;
    const double ramp = std::max(0.0, (moment.mjd - kRampMjd + moment.second / kSecondsPerDay) / 365.0);
    KnownOffsets known;
    known.ut1_minus_utc_s =
        ramp * (kTtMinusUtcIn1972_s - delta_t_at(kFirstLeapSecondMjd, kTtMinusUtcIn1972_s));
    known.tt_minus_utc_s =
        known.ut1_minus_utc_s + delta_t_at(moment.mjd, moment.second + kTtMinusUtcIn1972_s);
    return known;
}

/// From 1972 on.
KnownOffsets offsets_by_tai(const ClampedUtc& moment, const TaiOffset& offset) noexcept {
    KnownOffsets known;
    known.tt_minus_utc_s = offset.tai_minus_utc_s + kTtMinusTai_s;
    known.ut1_minus_utc_s =
        known.tt_minus_utc_s - delta_t_at(moment.mjd, moment.second + known.tt_minus_utc_s);
    known.leap_seconds_assumed = offset.assumed;
    return known;
}

bool is_usable(const std::optional<double>& offset_s) noexcept {
    constexpr double kMost_s = 3600.0;
    return offset_s && std::abs(*offset_s) <= kMost_s;
}

double given_or(const std::optional<double>& offset_s, double known_s) noexcept {
    return is_usable(offset_s) ? *offset_s : known_s;
}

double pole_or_zero(double angle_rad) noexcept {
    constexpr double kMost_rad = 1e-4;
    return std::abs(angle_rad) <= kMost_rad ? angle_rad : 0.0;
}

}  // namespace

bool is_valid(const CivilTime& time) noexcept {
    const std::optional<std::int32_t> mjd = mjd_of(time.year, time.month, time.day);
    if (!mjd || time.hour < 0 || time.hour > 23 || time.minute < 0 || time.minute > 59) return false;
    if (!(time.second >= 0.0)) return false;
    const bool last_minute = time.hour == 23 && time.minute == 59;
    const double minute_length_s = last_minute ? 60.0 + length_of_day_s(*mjd) - kSecondsPerDay : 60.0;
    return time.second < minute_length_s;
}

std::optional<UtcClockTime> UtcClockTime::from_civil(const CivilTime& time) noexcept {
    const std::optional<std::int32_t> mjd = mjd_of(time.year, time.month, time.day);
    if (!mjd || !is_valid(time)) return std::nullopt;
    const double minutes_s = 3600.0 * time.hour + 60.0 * time.minute;
    // A second just below the end of the day may round up to the end itself, which belongs to the next day.
    const double below_end_s = std::nextafter(length_of_day_s(*mjd), 0.0);
    return UtcClockTime(*mjd, std::min(minutes_s + time.second, below_end_s));
}

UtcClockTime UtcClockTime::from_unix(std::int64_t seconds, std::int32_t nanoseconds) noexcept {
    constexpr std::int64_t kDay_s = 86400;
    const std::int64_t rest_s = seconds % kDay_s;
    const std::int64_t second_of_day = rest_s < 0 ? rest_s + kDay_s : rest_s;
    const std::int64_t days = seconds / kDay_s - (rest_s < 0 ? 1 : 0);
    const std::int64_t mjd = std::clamp<std::int64_t>(days + kUnixEpochMjd, kFirstMjd, kLastMjd);
    const double fraction_s = 1e-9 * std::clamp(nanoseconds, 0, 999'999'999);
    return {static_cast<std::int32_t>(mjd), static_cast<double>(second_of_day) + fraction_s};
}

CivilTime UtcClockTime::civil() const noexcept {
    const Date date = date_of(mjd_);
    // The leap second belongs to the last minute, which then has 61.
    const int minute_of_day = std::min(static_cast<int>(second_of_day_ / 60.0), 24 * 60 - 1);
    return {.year = date.year,
            .month = date.month,
            .day = date.day,
            .hour = minute_of_day / 60,
            .minute = minute_of_day % 60,
            .second = second_of_day_ - 60.0 * minute_of_day};
}

void UtcClockTime::advance(double seconds) noexcept {
    if (!std::isfinite(seconds)) return;
    double second = second_of_day_ + seconds;
    if (second >= 0.0 && second < kSecondsPerDay) {
        second_of_day_ = second;
        return;
    }
    const double days =
        std::clamp(std::floor(second / kSecondsPerDay), 1.0 * (kFirstMjd - mjd_), 1.0 * (kLastMjd - mjd_));
    std::int32_t mjd = mjd_ + static_cast<std::int32_t>(days);
    second -= days * kSecondsPerDay + leap_seconds_before(mjd) - leap_seconds_before(mjd_);
    // What leap seconds have moved over a day's end is at most two days here, unless the years are left.
    while (second < 0.0 && mjd > kFirstMjd && second > -2.0 * kSecondsPerDay)
        second += length_of_day_s(--mjd);
    while (second >= length_of_day_s(mjd) && mjd < kLastMjd)
        second -= length_of_day_s(mjd++);
    mjd_ = mjd;
    second_of_day_ = std::clamp(second, 0.0, std::nextafter(length_of_day_s(mjd), 0.0));
}

double seconds_between(const UtcClockTime& earlier, const UtcClockTime& later) noexcept {
    const double days = static_cast<double>(later.mjd()) - static_cast<double>(earlier.mjd());
    const double leaps = leap_seconds_before(later.mjd()) - leap_seconds_before(earlier.mjd());
    return days * kSecondsPerDay + leaps + (later.second_of_day() - earlier.second_of_day());
}

std::optional<UtcClockTime> parse_utc(std::string_view text) noexcept {
    CivilTime time;
    const bool shaped =
        take_number(text, 4, time.year) && take_one_of(text, "-") && take_number(text, 2, time.month) &&
        take_one_of(text, "-") && take_number(text, 2, time.day) && take_one_of(text, "T ") &&
        take_number(text, 2, time.hour) && take_one_of(text, ":") && take_number(text, 2, time.minute);
    if (!shaped) return std::nullopt;
    if (take_one_of(text, ":") && !take_seconds(text, time.second)) return std::nullopt;
    take_one_of(text, "Z");
    if (!text.empty()) return std::nullopt;
    return UtcClockTime::from_civil(time);
}

std::string to_iso(const UtcClockTime& time, int decimals) {
    constexpr int kMostDecimals = 9;
    // Half a nanosecond forgives what a double cannot hold, such as sixty sixtieths of a second.
    constexpr double kForgiven_s = 5e-10;
    UtcClockTime shown = time;
    shown.advance(kForgiven_s);
    const CivilTime civil = shown.civil();
    const int places = std::clamp(decimals, 0, kMostDecimals);
    const int whole = static_cast<int>(civil.second);
    const std::string head = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", civil.year, civil.month,
                                         civil.day, civil.hour, civil.minute, whole);
    if (places == 0) return fmt::format("{}Z", head);
    const double fraction = std::floor((civil.second - whole) * std::pow(10.0, places));
    return fmt::format("{}.{:0{}.0f}Z", head, fraction, places);
}

KnownOffsets known_offsets(const UtcClockTime& utc) noexcept {
    const ClampedUtc moment = clamped(utc);
    return moment.mjd < kFirstLeapSecondMjd ? offsets_by_ut1(moment)
                                            : offsets_by_tai(moment, tai_offset(moment.mjd));
}

KnownOffsets OffsetsOfDay::at(const UtcClockTime& utc) noexcept {
    const ClampedUtc moment = clamped(utc);
    if (moment.mjd < kFirstLeapSecondMjd) return offsets_by_ut1(moment);
    if (moment.mjd != mjd_) {
        const TaiOffset offset = tai_offset(moment.mjd);
        mjd_ = moment.mjd;
        tai_minus_utc_s_ = offset.tai_minus_utc_s;
        assumed_ = offset.assumed;
    }
    return offsets_by_tai(moment, {tai_minus_utc_s_, assumed_});
}

Instant make_instant(const UtcClockTime& utc, const TimeOffsets& offsets) noexcept {
    return make_instant(utc, known_offsets(utc), offsets);
}

Instant make_instant(const UtcClockTime& utc, const KnownOffsets& known,
                     const TimeOffsets& offsets) noexcept {
    const ClampedUtc moment = clamped(utc);
    const double day = kJulianDateOfMjdZero + moment.mjd;
    const double tt_minus_utc_s = given_or(offsets.tt_minus_utc_s, known.tt_minus_utc_s);
    const double ut1_minus_utc_s = given_or(offsets.ut1_minus_utc_s, known.ut1_minus_utc_s);
    return {.tt = {day, (moment.second + tt_minus_utc_s) / kSecondsPerDay},
            .ut1 = {day, (moment.second + ut1_minus_utc_s) / kSecondsPerDay},
            .polar_x_rad = pole_or_zero(offsets.polar_x_rad),
            .polar_y_rad = pole_or_zero(offsets.polar_y_rad),
            .clamped = moment.outside,
            .leap_seconds_assumed = known.leap_seconds_assumed && !is_usable(offsets.tt_minus_utc_s)};
}

Instant make_instant(const UtcClockTime& utc, std::optional<double> ut1_minus_utc_s) noexcept {
    return make_instant(utc, TimeOffsets{.ut1_minus_utc_s = ut1_minus_utc_s});
}

JulianDate tai_from_tt(const JulianDate& tt) noexcept {
    return {tt.day, tt.fraction - kTtMinusTai_s / kSecondsPerDay};
}

double tdb_minus_tt_s(const JulianDate& tt) noexcept {
    constexpr double kRadPerDeg = 0.017453292519943295;
    const double days = (tt.day - kJ2000) + tt.fraction;
    const double anomaly_rad = (357.528 + 0.9856003 * days) * kRadPerDeg;
    return 0.001657 * std::sin(anomaly_rad);
}

JulianDate tdb_from_tt(const JulianDate& tt) noexcept {
    return {tt.day, tt.fraction + tdb_minus_tt_s(tt) / kSecondsPerDay};
}

}  // namespace skyig::server::ephemeris
