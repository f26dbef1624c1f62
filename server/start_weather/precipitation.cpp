#include "server/start_weather/precipitation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace skyig::server {
namespace {

constexpr double kSlope_1_mm = 4.1;
constexpr double kDrops_1_m3_mm = 8000.0;
/// g of one cubic millimetre of water.
constexpr double kWater_g_mm3 = 1e-3;

double slope_1_mm(double rate_mm_h) noexcept {
    return kSlope_1_mm * std::pow(rate_mm_h, -0.21);
}

}  // namespace

double rate_of_severity_mm_h(Falling kind, int severity) noexcept {
    using Rates = std::array<double, 6>;
    constexpr Rates kDrizzle{0.1, 0.2, 0.5, 1.0, 1.5, 2.0};
    constexpr Rates kRain{0.3, 1.0, 5.0, 15.0, 30.0, 50.0};
    constexpr Rates kSnow{0.2, 0.5, 2.0, 4.0, 6.0, 8.0};
    const auto at = static_cast<std::size_t>(std::clamp(severity, 0, 5));
    switch (kind) {
        case Falling::kDrizzle:
            return kDrizzle[at];
        case Falling::kSnow:
            return kSnow[at];
        case Falling::kRain:
        case Falling::kSleet:
        case Falling::kHail:
            break;
    }
    return kRain[at];
}

double water_g_m3(double rate_mm_h) noexcept {
    if (rate_mm_h <= 0.0) return 0.0;
    return std::numbers::pi * kWater_g_mm3 * kDrops_1_m3_mm / std::pow(slope_1_mm(rate_mm_h), 4.0);
}

double rate_of_water_mm_h(double water_g_m3) noexcept {
    if (water_g_m3 <= 0.0) return 0.0;
    const double slope = std::pow(std::numbers::pi * kWater_g_mm3 * kDrops_1_m3_mm / water_g_m3, 0.25);
    return std::pow(slope / kSlope_1_mm, -1.0 / 0.21);
}

double extinction_of_rate_per_m(Falling kind, double rate_mm_h) noexcept {
    if (rate_mm_h <= 0.0) return 0.0;
    if (kind == Falling::kSnow) {
        constexpr double kPerDecibel = std::numbers::ln10 / 10.0;
        return 5.5e-3 * std::pow(rate_mm_h, 1.38) * kPerDecibel;
    }
    return std::numbers::pi * kDrops_1_m3_mm / std::pow(slope_1_mm(rate_mm_h), 3.0) * 1e-6;
}

}  // namespace skyig::server
