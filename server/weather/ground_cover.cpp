#include "server/weather/ground_cover.h"

#include <algorithm>
#include <cmath>

namespace skyig::server::weather {

namespace {

constexpr double kHour_s = 3600.0;

double fresh_snow_kg_m3(double air_c) noexcept {
    return 67.92 + 51.25 * std::exp(std::min(air_c, 0.0) / 2.59);
}

double melt_mm_h(const Reaching& reaching) noexcept {
    constexpr double kByAir_mm_h_c = 3.0 / 24.0;
    constexpr double kByRain_per_c = 4.186 / 334.0;
    return std::max(reaching.air_c, 0.0) * (kByAir_mm_h_c + kByRain_per_c * reaching.rain_mm_h);
}

/// Where the film tends to.
double steady_mm(double rain_mm_h) noexcept {
    return rain_mm_h / kHour_s * GroundCover::kDrains_s;
}

}  // namespace

void GroundCover::settle(const Reaching& reaching) noexcept {
    water_mm_ = std::min(steady_mm(reaching.rain_mm_h), kHolds_mm);
}

void GroundCover::advance(const Reaching& reaching, double step_s) noexcept {
    const double hours = step_s / kHour_s;
    const double could_melt_mm = melt_mm_h(reaching) * hours;
    const double fallen_mm = reaching.snow_mm_h * hours;
    const double melted_mm = std::min(could_melt_mm, snow_mm_ + fallen_mm);
    // A millimetre of water is a kilogram a square metre.
    snow_depth_m_ += fallen_mm / fresh_snow_kg_m3(reaching.air_c);
    snow_mm_ += fallen_mm;
    const double left = snow_mm_ > 0.0 ? 1.0 - melted_mm / snow_mm_ : 0.0;
    snow_mm_ *= left;
    snow_depth_m_ *= left;
    const double arrives_mm_h = reaching.rain_mm_h + (hours > 0.0 ? melted_mm / hours : 0.0);
    const double steady = steady_mm(arrives_mm_h);
    water_mm_ = std::min(steady + (water_mm_ - steady) * std::exp(-step_s / kDrains_s), kHolds_mm);
}

double GroundCover::snow() const noexcept {
    constexpr double kRoughness_m = 0.01;
    return std::tanh(snow_depth_m_ / (2.5 * kRoughness_m));
}

}  // namespace skyig::server::weather
