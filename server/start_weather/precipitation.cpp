#include "server/start_weather/precipitation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "render/precipitation/fall.h"

namespace skyig::server {
namespace {

constexpr double kSlope_1_mm = 4.1;
constexpr double kDrops_1_m3_mm = 8000.0;
/// g of one cubic millimetre of water.
constexpr double kWater_g_mm3 = 1e-3;

}  // namespace

double rate_of_severity_mm_h(render::Precipitation::Kind kind, int severity) noexcept {
    using Kind = render::Precipitation::Kind;
    using Rates = std::array<double, 6>;
    constexpr Rates kDrizzle{0.1, 0.2, 0.5, 1.0, 1.5, 2.0};
    constexpr Rates kRain{0.3, 1.0, 5.0, 15.0, 30.0, 50.0};
    constexpr Rates kSnow{0.2, 0.5, 2.0, 4.0, 6.0, 8.0};
    const auto at = static_cast<std::size_t>(std::clamp(severity, 0, 5));
    switch (kind) {
        case Kind::kDrizzle:
            return kDrizzle[at];
        case Kind::kSnow:
            return kSnow[at];
        case Kind::kRain:
        case Kind::kSleet:
        case Kind::kHail:
            break;
    }
    return kRain[at];
}

double water_g_m3(double rate_mm_h) noexcept {
    if (rate_mm_h <= 0.0) return 0.0;
    return std::numbers::pi * kWater_g_mm3 * kDrops_1_m3_mm /
           std::pow(render::precipitation::rain_slope_per_mm(rate_mm_h), 4.0);
}

double rate_of_water_mm_h(double water_g_m3) noexcept {
    if (water_g_m3 <= 0.0) return 0.0;
    const double slope = std::pow(std::numbers::pi * kWater_g_mm3 * kDrops_1_m3_mm / water_g_m3, 0.25);
    return std::pow(slope / kSlope_1_mm, -1.0 / 0.21);
}

}  // namespace skyig::server
