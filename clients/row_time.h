// The moment that a row of a table names, in whichever of the usual columns.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/ephemeris/time.h"

namespace skyig::clients {

/// How a time column is written.
enum class TimeForm : std::uint8_t {
    kUtc,           ///< 2026-06-21T19:30:00Z, seconds up to 60.999 at a leap second; before 1971 UT1
    kTtJulianDate,  ///< decimal Julian date in TT
    kTtCivil        ///< written as UTC is, but in TT (eclipse catalogues: TD)
};

/// What a row may say of time besides its time column.
struct RowOffsets {
    std::optional<double> tt_minus_utc_s = std::nullopt;
    std::optional<double> ut1_minus_utc_s = std::nullopt;
    /// TT - UT1; with kTtCivil.
    std::optional<double> delta_t_s = std::nullopt;
};

/// The first and the last year a row may name.
inline constexpr int kFirstYear = 1900;
inline constexpr int kLastYear = 2100;

/// Decimal text as a two-part date that keeps all its digits: whole days and the rest. Nothing when the text
/// is no number.
[[nodiscard]] std::optional<server::ephemeris::JulianDate> parse_julian_date(std::string_view text) noexcept;

/// Nothing when the text has another form or names a time that does not exist. UT1 of kTtJulianDate stays
/// unset: such rows are geocentric.
[[nodiscard]] std::optional<server::ephemeris::Instant> parse_row_time(std::string_view text, TimeForm form,
                                                                       const RowOffsets& offsets) noexcept;

/// Within kFirstYear .. kLastYear.
[[nodiscard]] bool is_in_years(const server::ephemeris::JulianDate& tt) noexcept;

/// An example of the form, for error lines.
[[nodiscard]] std::string_view example_of(TimeForm form) noexcept;

}  // namespace skyig::clients
