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

// Density at a height as a share of that at sea level.
struct Thinned {
    double molecules;
    double aerosol;
};

Thinned thinned(double height_m) {
    return {std::exp(-height_m / kMoleculeHeight_m), std::exp(-height_m / kAerosolHeight_m)};
}

// Optical depth of both layers along a straight line of that length between two heights.
double depth(const TownAir& air, const Thinned& low, const Thinned& high, double rise_m, double length_m) {
    if (std::abs(rise_m) < 1.0)
        return (air.molecules_per_m * low.molecules + air.aerosol_per_m * low.aerosol) * length_m;
    return (air.molecules_per_m * kMoleculeHeight_m * (low.molecules - high.molecules) +
            air.aerosol_per_m * kAerosolHeight_m * (low.aerosol - high.aerosol)) *
           length_m / rise_m;
}

// Luminous intensity a lumen in a direction that rises so much and goes so far along the ground.
double sent_up(double up_m, double level_m, double path_m) {
    constexpr double kReflected = 0.15;
    constexpr double kDirect = 0.15;
    const double z = std::atan2(level_m, up_m);
    return (2.0 * kReflected * (1.0 - kDirect) * up_m / path_m + 0.554 * kDirect * z * z * z * z) /
           (2.0 * kPi);
}

double haze_phase(double cosine) {
    constexpr double kG = 0.7;
    const double base = 1.0 + kG * kG - 2.0 * kG * cosine;
    return (1.0 - kG * kG) / (4.0 * kPi * base * std::sqrt(base));
}

}  // namespace

double town_glow_cd_m2(double lumen, double radius_m, const TownAir& air, double distance_m,
                       double eye_height_m, double elevation_rad, double azimuth_rad) noexcept {
    constexpr int kSteps = 40;
    const glm::dvec3 ray{std::sin(azimuth_rad) * std::cos(elevation_rad),
                         std::cos(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad)};
    // Steps crowd where the ray passes the town: s = nearest + reach sinh(t), e = exp(t).
    const double height_m = std::clamp(eye_height_m, 0.0, kLidHeight_m);
    const double nearest_m = std::max(0.0, distance_m * ray.y);
    const double reach_m = 0.2 * radius_m + 0.1 * std::hypot(distance_m * ray.x, distance_m * ray.z) + 200.0;
    const double end_m = std::min(2.0 * distance_m + 20.0 * radius_m + 60e3,
                                  (kLidHeight_m - height_m) / std::max(ray.z, 1e-3) + 1.0);
    const double first = -std::asinh(nearest_m / reach_m);
    const double last = std::asinh((end_m - nearest_m) / reach_m);
    const double step = (last - first) / kSteps;
    const double ratio = std::exp(step);
    double e = std::exp(first - 0.5 * step);
    const Thinned at_ground{1.0, 1.0};
    const Thinned at_eye = thinned(height_m);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        e *= ratio;
        const double s_m = nearest_m + 0.5 * reach_m * (e - 1.0 / e);
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
        const Thinned here = thinned(z_m);
        const double passes = std::exp(-depth(air, at_ground, here, z_m, path_m) -
                                       depth(air, at_eye, here, z_m - height_m, s_m));
        const double lux =
            lumen * sent_up(up_m, std::sqrt(level2), path_m) / (path2 + 0.5 * radius_m * radius_m);
        const double molecules =
            air.molecules_per_m * here.molecules * 3.0 / (16.0 * kPi) * (1.0 + turn * turn);
        const double haze = 0.94 * air.aerosol_per_m * here.aerosol * haze_phase(turn);
        sum += lux * (molecules + haze) * passes * 0.5 * reach_m * (e + 1.0 / e) * step;
    }
    return sum;
}

double town_lumen(const City& city, const TownAir& air) noexcept {
    if (city.zenith_cd_m2 <= 0.0) return kLumenAHead * city.population;
    return city.zenith_cd_m2 / town_glow_cd_m2(1.0, city.radius_m, air, 0.0, 0.0, 0.5 * kPi, 0.0);
}

double LightDome::height_step_m(double height_m) noexcept {
    return 0.01 * (std::max(height_m, 0.0) + 500.0);
}

void LightDome::aim(const City& city, const TownAir& air, double distance_m, double eye_height_m) noexcept {
    const bool serves = city_ == city && air_ == air &&
                        std::abs(distance_m_ - distance_m) < 0.01 * (distance_m + city.radius_m) &&
                        std::abs(eye_height_m_ - eye_height_m) < height_step_m(eye_height_m_);
    if (serves) return;
    city_ = city;
    air_ = air;
    distance_m_ = distance_m;
    eye_height_m_ = eye_height_m;
    lumen_ = town_lumen(city, air);
    next_row_ = 0;
}

bool LightDome::build_rows(int most_rows) noexcept {
    const int last = std::min(next_row_ + most_rows, kRows);
    for (; next_row_ < last; ++next_row_) {
        const double up = static_cast<double>(next_row_) / (kRows - 1);
        double* row = &log2_cd_m2_[static_cast<std::size_t>(next_row_) * kColumns];
        for (int column = 0; column < kColumns; ++column) {
            const double round = static_cast<double>(column) / (kColumns - 1);
            const double glow = town_glow_cd_m2(lumen_, city_.radius_m, air_, distance_m_, eye_height_m_,
                                                0.5 * kPi * up * up, kPi * round * round);
            row[column] = std::log2(std::max(glow, kLeast_cd_m2));
        }
    }
    return complete();
}

double LightDome::luminance_cd_m2(double elevation_rad, double azimuth_rad) const noexcept {
    const double up = std::sqrt(std::clamp(elevation_rad / (0.5 * kPi), 0.0, 1.0)) * (kRows - 1);
    const double round = std::sqrt(std::abs(std::remainder(azimuth_rad, 2.0 * kPi)) / kPi) * (kColumns - 1);
    const auto row = std::min(static_cast<std::size_t>(up), std::size_t{kRows} - 2);
    const auto column = std::min(static_cast<std::size_t>(round), std::size_t{kColumns} - 2);
    const double* at = &log2_cd_m2_[row * kColumns + column];
    const double along = round - static_cast<double>(column);
    return std::exp2(std::lerp(std::lerp(at[0], at[1], along),
                               std::lerp(at[kColumns], at[kColumns + 1], along),
                               up - static_cast<double>(row)));
}

}  // namespace skyig::render::night
