#include "clients/row_time.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "clients/csv.h"

namespace skyig::clients {

using server::ephemeris::Instant;
using server::ephemeris::JulianDate;
using server::ephemeris::UtcClockTime;

namespace {

constexpr double kSecondsPerDay = 86400.0;
constexpr double kJulianDateOfMjdZero = 2400000.5;

/// 1900-01-01 and 2101-01-01, with the minute that TT may be ahead or behind.
constexpr double kFirstJd = 2415020.5;
constexpr double kEndJd = 2488434.5;
constexpr double kMargin_d = 120.0 / kSecondsPerDay;

bool is_digits(std::string_view text) noexcept {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

Instant tt_instant(const UtcClockTime& tt, const std::optional<double>& delta_t_s) noexcept {
    Instant instant;
    instant.tt = {kJulianDateOfMjdZero + tt.mjd(), tt.second_of_day() / kSecondsPerDay};
    // The tables answer for UTC: ask them at UTC as they know it, which is a minute from TT.
    UtcClockTime utc = tt;
    utc.advance(-server::ephemeris::known_offsets(tt).tt_minus_utc_s);
    const server::ephemeris::KnownOffsets known = server::ephemeris::known_offsets(utc);
    const double lag_s = delta_t_s.value_or(known.tt_minus_utc_s - known.ut1_minus_utc_s);
    instant.ut1 = {instant.tt.day, (tt.second_of_day() - lag_s) / kSecondsPerDay};
    return instant;
}

}  // namespace

std::optional<JulianDate> parse_julian_date(std::string_view text) noexcept {
    const std::size_t point = text.find('.');
    if (point != std::string_view::npos && point > 0 && point < 10 && is_digits(text.substr(0, point)) &&
        is_digits(text.substr(point + 1))) {
        std::int64_t days = 0;
        std::from_chars(text.data(), text.data() + point, days);
        double fraction = 0.0;
        if (point + 1 < text.size())
            std::from_chars(text.data() + point, text.data() + text.size(), fraction);
        return JulianDate{static_cast<double>(days), fraction};
    }
    const std::optional<double> days = parse_number(text);
    if (!days) return std::nullopt;
    return JulianDate{std::floor(*days), *days - std::floor(*days)};
}

std::optional<Instant> parse_row_time(std::string_view text, TimeForm form,
                                      const RowOffsets& offsets) noexcept {
    if (form == TimeForm::kTtJulianDate) {
        const std::optional<JulianDate> tt = parse_julian_date(text);
        if (!tt) return std::nullopt;
        Instant instant;
        instant.tt = *tt;
        return instant;
    }
    const std::optional<UtcClockTime> time = server::ephemeris::parse_utc(text);
    if (!time) return std::nullopt;
    if (form == TimeForm::kTtCivil) return tt_instant(*time, offsets.delta_t_s);
    server::ephemeris::TimeOffsets given;
    given.tt_minus_utc_s = offsets.tt_minus_utc_s;
    given.ut1_minus_utc_s = offsets.ut1_minus_utc_s;
    return server::ephemeris::make_instant(*time, given);
}

bool is_in_years(const JulianDate& tt) noexcept {
    const double jd = tt.day + tt.fraction;
    return jd >= kFirstJd - kMargin_d && jd < kEndJd + kMargin_d;
}

std::string_view example_of(TimeForm form) noexcept {
    switch (form) {
        case TimeForm::kUtc:
            return "2026-06-21T19:30:00Z";
        case TimeForm::kTtJulianDate:
            return "2461213.3125";
        case TimeForm::kTtCivil:
            return "2026-06-21T19:30:00.0";
    }
    return {};
}

}  // namespace skyig::clients
