// Civil UTC, a UTC clock that can be advanced, and the time scales that the sky is computed from.
// None of this reads a clock: time comes in as data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace skyig::server::ephemeris {

/// A date and time of day in UTC, proleptic Gregorian. Before 1971 the same fields mean UT1.
struct CivilTime {
    int year = 2000;
    int month = 1;
    int day = 1;
    int hour = 12;
    int minute = 0;
    /// 0 <= second < 60; up to 61 in the last minute of a day that ends with a leap second.
    double second = 0.0;

    friend bool operator==(const CivilTime&, const CivilTime&) = default;
};

/// True for a date that exists (year 1..9999) and a time of day that exists on it, leap seconds included.
[[nodiscard]] bool is_valid(const CivilTime& time) noexcept;

/// A UTC instant as day and seconds of day: resolves 2e-11 s at any date, and 23:59:60 is a value of its own.
/// Always valid: 0 <= second_of_day < length of that day. Advancing counts SI seconds, leap seconds included.
class UtcClockTime {
  public:
    /// 2000-01-01T12:00:00Z.
    constexpr UtcClockTime() noexcept = default;

    /// \return nothing when `time` does not exist.
    [[nodiscard]] static std::optional<UtcClockTime> from_civil(const CivilTime& time) noexcept;
    /// From a POSIX clock (seconds since 1970 without leap seconds). `nanoseconds` in 0..999'999'999.
    [[nodiscard]] static UtcClockTime from_unix(std::int64_t seconds, std::int32_t nanoseconds = 0) noexcept;

    [[nodiscard]] CivilTime civil() const noexcept;
    /// Modified Julian Day number of the UTC day.
    [[nodiscard]] std::int32_t mjd() const noexcept { return mjd_; }
    [[nodiscard]] double second_of_day() const noexcept { return second_of_day_; }

    /// Moves by `seconds`, either way. Not-a-number and infinity move nothing; the result stays in the
    /// years 1..9999.
    void advance(double seconds) noexcept;

    friend bool operator==(const UtcClockTime&, const UtcClockTime&) = default;

  private:
    constexpr UtcClockTime(std::int32_t mjd, double second_of_day) noexcept
        : mjd_(mjd), second_of_day_(second_of_day) {}

    std::int32_t mjd_ = 51544;
    double second_of_day_ = 43200.0;
};

/// SI seconds from `earlier` to `later` (negative when they are the other way round), leap seconds included.
[[nodiscard]] double seconds_between(const UtcClockTime& earlier, const UtcClockTime& later) noexcept;

/// Reads "2026-06-21T19:30:00Z", with or without seconds, fraction of a second, or Z; a space may stand for
/// T. \return nothing when the text has another shape or names a time that does not exist.
[[nodiscard]] std::optional<UtcClockTime> parse_utc(std::string_view text) noexcept;

/// "2026-06-21T19:30:00Z". `decimals` 0..9 of a second; cut off, not rounded, so that no :60 appears by
/// rounding.
[[nodiscard]] std::string to_iso(const UtcClockTime& time, int decimals = 0);

/// A Julian date in two parts that are added; `day` is a whole or half number, `fraction` small.
struct JulianDate {
    double day = 2451545.0;
    double fraction = 0.0;

    friend bool operator==(const JulianDate&, const JulianDate&) = default;
};

/// One moment in the two scales that the sky needs: TT moves the bodies, UT1 turns the Earth.
struct Instant {
    JulianDate tt{2451544.5, 0.5 + 64.184 / 86400.0};
    JulianDate ut1{2451544.5, 0.5 + 0.355 / 86400.0};
    /// Coordinates of the pole (ITRS, as bulletins give them); 0 without a file of Earth orientation.
    double polar_x_rad = 0.0;
    double polar_y_rad = 0.0;
    /// The UTC was outside 1900-01-01 .. 2100-12-31 and the nearest end of that span is used.
    bool clamped = false;
    /// No leap seconds are announced that far ahead: TT - UTC is held at its last value. No error; worth one
    /// log line.
    bool leap_seconds_assumed = false;

    friend bool operator==(const Instant&, const Instant&) = default;
};

/// What is known of a moment better than the built-in tables do. What is absent, not finite or more than an
/// hour comes from the tables; a pole that is not finite or beyond 1e-4 rad is 0.
struct TimeOffsets {
    std::optional<double> tt_minus_utc_s = std::nullopt;
    /// Taken as given: at a leap second it has to step by one second, together with UTC.
    std::optional<double> ut1_minus_utc_s = std::nullopt;
    double polar_x_rad = 0.0;
    double polar_y_rad = 0.0;

    friend bool operator==(const TimeOffsets&, const TimeOffsets&) = default;
};

/// What the tables say of a moment.
struct KnownOffsets {
    double tt_minus_utc_s = 0.0;
    double ut1_minus_utc_s = 0.0;
    bool leap_seconds_assumed = false;
};

/// From 1972: TT - UTC = leap seconds + 32.184 s (table of the ERFA library; its last value, 69.184 s in all,
/// beyond) and UT1 = TT - delta_t_s(). To the end of 1970 the clock's UTC means UT1, TT = UT1 + delta_t_s();
/// within 1971 it turns into UTC, which is 0.045 s. Neither TT nor UT1 steps anywhere: both run strictly
/// forwards, through every leap second. Dates beyond 1900..2100 are taken as the nearer end.
[[nodiscard]] KnownOffsets known_offsets(const UtcClockTime& utc) noexcept;

/// The same, to the bit, for a clock that is asked each frame: what holds for a whole UTC day, its leap
/// seconds, is looked up when the day changes and kept. One object a thread.
class OffsetsOfDay {
  public:
    [[nodiscard]] KnownOffsets at(const UtcClockTime& utc) noexcept;

  private:
    /// Of day 0, which lies before leap seconds and is never asked for.
    std::int32_t mjd_ = 0;
    double tai_minus_utc_s_ = 0.0;
    bool assumed_ = false;
};

/// TT and UT1 of a UTC instant: known_offsets(), where `offsets` does not say otherwise. A leap second,
/// 23:59:60, is 86400 s after 0h of its day, and the offsets are those of that day. Always finite.
[[nodiscard]] Instant make_instant(const UtcClockTime& utc, const TimeOffsets& offsets) noexcept;
/// The same for who has looked up `known` = known_offsets(utc) already.
[[nodiscard]] Instant make_instant(const UtcClockTime& utc, const KnownOffsets& known,
                                   const TimeOffsets& offsets) noexcept;
[[nodiscard]] Instant make_instant(const UtcClockTime& utc,
                                   std::optional<double> ut1_minus_utc_s = std::nullopt) noexcept;

/// TAI = TT - 32.184 s.
[[nodiscard]] JulianDate tai_from_tt(const JulianDate& tt) noexcept;

/// TDB - TT at the Earth's centre, within 0.0017 s: 0.001657 s sin(g), g the Earth's mean anomaly. Error
/// against ERFA's full series, 1900-2100: 0.00005 s.
[[nodiscard]] double tdb_minus_tt_s(const JulianDate& tt) noexcept;
[[nodiscard]] JulianDate tdb_from_tt(const JulianDate& tt) noexcept;

}  // namespace skyig::server::ephemeris
