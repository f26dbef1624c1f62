// How far the turning Earth lags behind uniform time.
#pragma once

namespace skyig::server::ephemeris {

/// Years of the table behind delta_t_s(): before the first its value is held, from the last on it is
/// kHeldDeltaT_s.
inline constexpr double kFirstDeltaTYear = 1900.0;
inline constexpr double kLastDeltaTYear = 2027.0;
/// TT - UTC since 2017: with it UT1 - UTC is zero for as long as nobody knows better.
inline constexpr double kHeldDeltaT_s = 69.184;

/// TT - UT1 in seconds at a Julian epoch (2000 + Julian years since 2000-01-01T00). Continuous, and its
/// slope stays below 1e-7, so that UT1 made from TT with it always runs forwards. Not-a-number gives
/// kHeldDeltaT_s.
///
/// Measured values at each year's start, cubic between them (Catmull-Rom): to 1971 the spline of Morrison,
/// Stephenson, Hohenkerk & Zawilski 2021 (Proc. R. Soc. A 477, 20200776, table S15), from 1972 IERS and US
/// Naval Observatory; from 1972 the Earth's seasons are added as the BIH has them in UT2 - UT1. The step to
/// the held value is taken within 2026. Error against the daily values of JPL Horizons' tables, 1900-2019:
/// 0.02 s to 1961, then 0.035 s (0.5 arcsec of the Earth's turning), rms 0.013 s. After 2026 nobody knows:
/// tenths of a second by 2030, tens of seconds by 2100.
[[nodiscard]] double delta_t_s(double year) noexcept;

}  // namespace skyig::server::ephemeris
