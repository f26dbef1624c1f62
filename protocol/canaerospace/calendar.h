// Days of the Gregorian calendar, counted.
#pragma once

#include <cstdint>

namespace skyig::protocol::canaerospace {

[[nodiscard]] constexpr bool is_leap_year(std::int64_t year) noexcept {
    return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

/// month 1..12
[[nodiscard]] constexpr int days_in_month(std::int64_t year, int month) noexcept {
    if (month == 2) return is_leap_year(year) ? 29 : 28;
    return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

/// Days since 1970-01-01; year 0..9999, month 1..12. Counts whole years from 1 March, so that the leap day
/// ends one.
[[nodiscard]] constexpr std::int64_t days_since_1970(std::int64_t year, int month, int day) noexcept {
    const std::int64_t years = year - (month <= 2 ? 1 : 0) + 400;  // never negative
    const std::int64_t months_since_march = (month + 9) % 12;
    const std::int64_t days_before_month = (153 * months_since_march + 2) / 5;
    return 365 * years + years / 4 - years / 100 + years / 400 + days_before_month + day - 1 -
           (719'468 + 146'097);
}
static_assert(days_since_1970(1970, 1, 1) == 0);
static_assert(days_since_1970(2000, 3, 1) == 11'017);
static_assert(days_since_1970(0, 1, 1) == -719'528);

}  // namespace skyig::protocol::canaerospace
