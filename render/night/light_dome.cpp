#include "render/night/light_dome.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "render/geometry.h"

namespace skyig::render::night {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMoleculeHeight_m = 8000.0;
constexpr double kAerosolHeight_m = 1200.0;
constexpr double kLidHeight_m = 40e3;
constexpr double kLumenAHead = 1000.0;
constexpr double kLeast_cd_m2 = 1e-12;

// Optical depth of an exponential layer between two heights, along a straight line of that length.
double depth(double per_m, double scale_m, double low_m, double high_m, double length_m) {
    const double rise = high_m - low_m;
    if (std::abs(rise) < 1.0) return per_m * std::exp(-low_m / scale_m) * length_m;
    return per_m * scale_m * (std::exp(-low_m / scale_m) - std::exp(-high_m / scale_m)) * length_m / rise;
}

double passes(const TownAir& air, double low_m, double high_m, double length_m) {
    return std::exp(-depth(air.molecules_per_m, kMoleculeHeight_m, low_m, high_m, length_m) -
                    depth(air.aerosol_per_m, kAerosolHeight_m, low_m, high_m, length_m));
}

// Luminous intensity a lumen, by the angle from straight up.
double sent_up(double cosine) {
    constexpr double kReflected = 0.15;
    constexpr double kDirect = 0.15;
    const double z = std::acos(std::clamp(cosine, 0.0, 1.0));
    return (2.0 * kReflected * (1.0 - kDirect) * std::max(cosine, 0.0) + 0.554 * kDirect * z * z * z * z) /
           (2.0 * kPi);
}

double haze_phase(double cosine) {
    constexpr double kG = 0.7;
    const double base = 1.0 + kG * kG - 2.0 * kG * cosine;
    return (1.0 - kG * kG) / (4.0 * kPi * base * std::sqrt(base));
}

double row_elevation_rad(double row, double rows) {
    const double share = row / rows;
    return 0.5 * kPi * share * share;
}

}  // namespace

double town_glow_cd_m2(double lumen, double radius_m, const TownAir& air, double distance_m,
                       double eye_height_m, double elevation_rad, double azimuth_rad) noexcept {
    constexpr int kSteps = 40;
    const glm::dvec3 ray{std::sin(azimuth_rad) * std::cos(elevation_rad),
                         std::cos(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad)};
    // Steps crowd where the ray passes the town: s = nearest + reach sinh(t).
    const double height_m = std::clamp(eye_height_m, 0.0, kLidHeight_m);
    const double nearest_m = std::max(0.0, distance_m * ray.y);
    const double reach_m = 0.2 * radius_m + 0.1 * std::hypot(distance_m * ray.x, distance_m * ray.z) + 200.0;
    const double end_m = std::min(2.0 * distance_m + 20.0 * radius_m + 60e3,
                                  (kLidHeight_m - height_m) / std::max(ray.z, 1e-3) + 1.0);
    const double first = -std::asinh(nearest_m / reach_m);
    const double last = std::asinh((end_m - nearest_m) / reach_m);
    const double step = (last - first) / kSteps;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double t = first + (i + 0.5) * step;
        const double s_m = nearest_m + reach_m * std::sinh(t);
        const glm::dvec3 at = ray * s_m;
        const double bulge_m = 0.5 * (at.x * at.x + at.y * at.y) / kEarthRadius_m;
        const double z_m = height_m + at.z + bulge_m;
        if (z_m > kLidHeight_m) break;
        const double across_m = distance_m - at.y;
        const double level2 = at.x * at.x + across_m * across_m;
        // Above the town's own horizon plane.
        const double up_m = z_m - 0.5 * level2 / kEarthRadius_m;
        if (up_m <= 0.0) continue;
        const double path2 = level2 + up_m * up_m;
        const double path_m = std::sqrt(path2);
        const glm::dvec3 from_town{at.x, -across_m, up_m};
        const double turn = -glm::dot(from_town, ray) / path_m;
        const double lux = lumen * sent_up(up_m / path_m) / (path2 + 0.5 * radius_m * radius_m) *
                           passes(air, 0.0, z_m, path_m);
        const double molecules = air.molecules_per_m * std::exp(-z_m / kMoleculeHeight_m) * 3.0 /
                                 (16.0 * kPi) * (1.0 + turn * turn);
        const double haze = 0.94 * air.aerosol_per_m * std::exp(-z_m / kAerosolHeight_m) * haze_phase(turn);
        sum += lux * (molecules + haze) * passes(air, height_m, z_m, s_m) * reach_m * std::cosh(t) * step;
    }
    return sum;
}

double town_lumen(const City& city, const TownAir& air) noexcept {
    if (city.zenith_cd_m2 <= 0.0) return kLumenAHead * city.population;
    return city.zenith_cd_m2 / town_glow_cd_m2(1.0, city.radius_m, air, 0.0, 0.0, 0.5 * kPi, 0.0);
}

void LightDome::build(const City& city, const TownAir& air, double distance_m, double eye_height_m) noexcept {
    const double lumen = town_lumen(city, air);
    for (std::size_t row = 0; row < kRows; ++row) {
        const double elevation_rad = row_elevation_rad(static_cast<double>(row), kRows - 1);
        for (std::size_t column = 0; column < kColumns; ++column) {
            const double share = static_cast<double>(column) / (kColumns - 1);
            const double glow = town_glow_cd_m2(lumen, city.radius_m, air, distance_m, eye_height_m,
                                                elevation_rad, kPi * share * share);
            log2_cd_m2_[row * kColumns + column] = std::log2(std::max(glow, kLeast_cd_m2));
        }
    }
}

double LightDome::luminance_cd_m2(double elevation_rad, double azimuth_rad) const noexcept {
    const double up = std::sqrt(std::clamp(elevation_rad / (0.5 * kPi), 0.0, 1.0)) * (kRows - 1);
    const double round = std::sqrt(std::abs(std::remainder(azimuth_rad, 2.0 * kPi)) / kPi) * (kColumns - 1);
    const auto row = std::min(static_cast<std::size_t>(up), kRows - 2);
    const auto column = std::min(static_cast<std::size_t>(round), kColumns - 2);
    const double* at = &log2_cd_m2_[row * kColumns + column];
    const double along = round - static_cast<double>(column);
    return std::exp2(std::lerp(std::lerp(at[0], at[1], along),
                               std::lerp(at[kColumns], at[kColumns + 1], along),
                               up - static_cast<double>(row)));
}

}  // namespace skyig::render::night
