// How much what falls dims the view. Pure functions of the rate, for whoever turns weather into an Obscurant.
#pragma once

#include "render/weather.h"

namespace skyig::render::precipitation {

// All rates are of liquid water, mm/h; below 0 they count as 0. Extinction of visible light, 1/m: twice the
// geometric cross section of all drops, finite for every finite rate.

/// Marshall and Palmer 1948: N(D) = 8000 exp(-4.1 R^-0.21 D) drops a m3 and mm; sigma = pi 8000 / L^3 * 1e-6.
[[nodiscard]] double rain_extinction_per_m(double rate_mm_h) noexcept;

/// Joss, Thams and Waldvogel 1968, drizzle: N(D) = 30000 exp(-5.7 R^-0.21 D).
[[nodiscard]] double drizzle_extinction_per_m(double rate_mm_h) noexcept;

/// Fits to optical links: dry 5.5 R^1.38, wet 3.8 R^0.72 dB/km. \param wet  0 dry .. 1 wet, linear between
[[nodiscard]] double snow_extinction_per_m(double rate_mm_h, double wet) noexcept;

/// Stones of 1 cm that fall at 9 m/s, a tenth of their volume air: 3 R / (0.9 D v). Hail alone dims little.
[[nodiscard]] double hail_extinction_per_m(double rate_mm_h) noexcept;

/// How wet snow is: 0 below -2 C, 1 above +1 C.
[[nodiscard]] double snow_wetness(double temperature_c) noexcept;

/// One of the above. Sleet: half its water falls as rain, half as wet snow.
[[nodiscard]] double extinction_per_m(Precipitation::Kind kind, double rate_mm_h,
                                      double temperature_c) noexcept;

}  // namespace skyig::render::precipitation
