#include "render/precipitation/extinction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/geometry.h"
#include "render/precipitation/fall.h"

namespace skyig::render::precipitation {

namespace {

// Of drops whose number falls exponentially with diameter, N0 exp(-L D): the integral of Q pi/4 D^2 N, Q = 2.
double exponential_extinction_per_m(double n0_per_m3_mm, double slope_per_mm) {
    return std::numbers::pi * n0_per_m3_mm / (slope_per_mm * slope_per_mm * slope_per_mm) * 1e-6;
}

double per_m_of_db_km(double db_km) {
    return db_km * std::numbers::ln10 / 1e4;
}

}  // namespace

double rain_extinction_per_m(double rate_mm_h) noexcept {
    return rate_mm_h > 0.0 ? exponential_extinction_per_m(8000.0, rain_slope_per_mm(rate_mm_h)) : 0.0;
}

double drizzle_extinction_per_m(double rate_mm_h) noexcept {
    return rate_mm_h > 0.0 ? exponential_extinction_per_m(30000.0, drizzle_slope_per_mm(rate_mm_h)) : 0.0;
}

double snow_extinction_per_m(double rate_mm_h, double wet) noexcept {
    const double rate = std::max(rate_mm_h, 0.0);
    const double share = std::clamp(wet, 0.0, 1.0);
    return per_m_of_db_km((1.0 - share) * 5.5 * std::pow(rate, 1.38) + share * 3.8 * std::pow(rate, 0.72));
}

double hail_extinction_per_m(double rate_mm_h) noexcept {
    constexpr double kIce = 0.9;
    constexpr double kPerHour_m_s = 1e-3 / 3600.0;
    return 3.0 * std::max(rate_mm_h, 0.0) * kPerHour_m_s /
           (kIce * 1e-3 * kHail_mm * hail_fall_speed_m_s(kHail_mm));
}

double snow_wetness(double temperature_c) noexcept {
    return smooth_step(-2.0, 1.0, temperature_c);
}

double extinction_per_m(Precipitation::Kind kind, double rate_mm_h, double temperature_c) noexcept {
    using Kind = Precipitation::Kind;
    switch (kind) {
        case Kind::kRain:
            return rain_extinction_per_m(rate_mm_h);
        case Kind::kDrizzle:
            return drizzle_extinction_per_m(rate_mm_h);
        case Kind::kSnow:
            return snow_extinction_per_m(rate_mm_h, snow_wetness(temperature_c));
        case Kind::kSleet:
            return rain_extinction_per_m(0.5 * rate_mm_h) + snow_extinction_per_m(0.5 * rate_mm_h, 1.0);
        case Kind::kHail:
            return hail_extinction_per_m(rate_mm_h);
    }
    return 0.0;
}

}  // namespace skyig::render::precipitation
