#include "server/ephemeris/delta_t.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace skyig::server::ephemeris {
namespace {

/// TT - UT1 on 1 January 0h of 1900 .. 2027, s. The last one is no measurement.
constexpr std::array kAtYearStart_s{
    // 1900
    -1.977, -0.746, 0.619, 2.060, 3.515, 4.923, 6.241, 7.488, 8.697, 9.903,
    // 1910
    11.142, 12.435, 13.754, 15.061, 16.315, 17.479, 18.519, 19.440, 20.255, 20.976,
    // 1920
    21.617, 22.187, 22.689, 23.123, 23.489, 23.789, 24.023, 24.197, 24.317, 24.389,
    // 1930
    24.418, 24.412, 24.376, 24.318, 24.245, 24.164, 24.085, 24.038, 24.056, 24.174,
    // 1940
    24.426, 24.830, 25.347, 25.925, 26.511, 27.050, 27.505, 27.892, 28.239, 28.575,
    // 1950
    28.932, 29.322, 29.699, 30.002, 30.203, 30.409, 30.760, 31.343, 32.032, 32.652,
    // 1960
    33.073, 33.358, 33.621, 33.963, 34.439, 35.093, 35.947, 36.932, 37.956, 38.948,
    // 1970
    39.932, 40.951, 42.2295, 43.3729, 44.4840, 45.4761, 46.4567, 47.5214, 48.5344, 49.5861,
    // 1980
    50.5387, 51.3808, 52.1668, 52.9565, 53.7882, 54.3427, 54.8712, 55.3222, 55.8197, 56.3000,
    // 1990
    56.8553, 57.5653, 58.3092, 59.1218, 59.9844, 60.7853, 61.6287, 62.2950, 62.9659, 63.4673,
    // 2000
    63.8285, 64.0908, 64.2998, 64.4734, 64.5736, 64.6876, 64.8452, 65.1464, 65.4574, 65.7768,
    // 2010
    66.0699, 66.3246, 66.6030, 66.9069, 67.2810, 67.6439, 68.1024, 68.5927, 68.9676, 69.2202,
    // 2020
    69.3612, 69.3594, 69.2945, 69.2039, 69.1752, 69.1377, 69.1099, kHeldDeltaT_s};

static_assert(kAtYearStart_s.size() == static_cast<std::size_t>(kLastDeltaTYear - kFirstDeltaTYear) + 1);

/// UT2 - UT1 less its value at the year's start, so that it fits between values that contain it.
double seasons_s(double year_part) noexcept {
    constexpr double kTwoPi = 6.28318530717958648;
    const double s = std::sin(kTwoPi * year_part);
    const double c = std::cos(kTwoPi * year_part);
    return 0.022 * s - 0.012 * c - 0.006 * (2.0 * s * c) + 0.007 * (c * c - s * s) + 0.005;
}

}  // namespace

double delta_t_s(double year) noexcept {
    constexpr double kFirstYearWithSeasons = 1972.0;
    if (year <= kFirstDeltaTYear) return kAtYearStart_s.front();
    if (!(year < kLastDeltaTYear)) return kHeldDeltaT_s;
    const double whole = std::floor(year - kFirstDeltaTYear);
    const auto i = static_cast<std::size_t>(whole);
    const double t = year - kFirstDeltaTYear - whole;

    const double from = kAtYearStart_s[i];
    const double to = kAtYearStart_s[i + 1];
    const double before = i > 0 ? kAtYearStart_s[i - 1] : 2.0 * from - to;
    const double after = i + 2 < kAtYearStart_s.size() ? kAtYearStart_s[i + 2] : to;
    const double from_slope = 0.5 * (to - before);
    const double to_slope = 0.5 * (after - from);
    const double cubic = from + t * from_slope + t * t * (3.0 * (to - from) - 2.0 * from_slope - to_slope) +
                         t * t * t * (2.0 * (from - to) + from_slope + to_slope);
    return year < kFirstYearWithSeasons ? cubic : cubic + seasons_s(t);
}

}  // namespace skyig::server::ephemeris
