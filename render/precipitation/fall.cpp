#include "render/precipitation/fall.h"

#include <algorithm>
#include <cmath>

#include "render/sky/standard_air.h"

namespace skyig::render::precipitation {

double rain_slope_per_mm(double rate_mm_h) noexcept {
    return 4.1 * std::pow(rate_mm_h, -0.21);
}

double drizzle_slope_per_mm(double rate_mm_h) noexcept {
    return 5.7 * std::pow(rate_mm_h, -0.21);
}

double median_drop_mm(double slope_per_mm) noexcept {
    return 3.67 / slope_per_mm;
}

double drop_fall_speed_m_s(double diameter_mm) noexcept {
    return std::max(0.0, 9.65 - 10.3 * std::exp(-0.6 * diameter_mm));
}

double hail_fall_speed_m_s(double diameter_mm) noexcept {
    return 9.0 * std::sqrt(0.1 * diameter_mm);
}

double aloft_factor(double height_m) noexcept {
    const sky::StandardAir air;
    // Refractivity goes with density.
    const double density = air.at(std::clamp(height_m, -500.0, 20e3)).refractivity / air.at(0.0).refractivity;
    return std::pow(density, -0.4);
}

double fall_speed_m_s(Precipitation::Kind kind, double rate_mm_h, double height_m) noexcept {
    using Kind = Precipitation::Kind;
    // Flakes, dry and wet.
    constexpr double kSnow_m_s = 1.0;
    constexpr double kSleet_m_s = 3.0;
    double speed_m_s = 0.0;
    switch (kind) {
        case Kind::kRain:
            speed_m_s = drop_fall_speed_m_s(median_drop_mm(rain_slope_per_mm(rate_mm_h)));
            break;
        case Kind::kDrizzle:
            speed_m_s = drop_fall_speed_m_s(median_drop_mm(drizzle_slope_per_mm(rate_mm_h)));
            break;
        case Kind::kSnow:
            speed_m_s = kSnow_m_s;
            break;
        case Kind::kSleet:
            speed_m_s = kSleet_m_s;
            break;
        case Kind::kHail:
            speed_m_s = hail_fall_speed_m_s(kHail_mm);
            break;
    }
    return speed_m_s * aloft_factor(height_m);
}

glm::dvec3 relative_wind_m_s(const Weather& weather, double fall_speed_m_s) noexcept {
    return weather.wind_m_s - weather.eye_velocity_m_s - glm::dvec3{0.0, 0.0, fall_speed_m_s};
}

}  // namespace skyig::render::precipitation
