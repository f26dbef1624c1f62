#include "render/night/night_floor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::render::night {

namespace {

constexpr double kEarthRadius_m = 6371e3;
constexpr double kAirglowHeight_m = 90e3;
constexpr double kExtinction_mag = 0.17;
constexpr double kScaleHeight_m = 8e3;

// Colour of the dark sky, B-V about 1.0: chromaticity of a star of that index.
constexpr glm::dvec3 kFloorColour{1.04, 1.0, 0.66};

// Luminance of level ground of albedo 0.1 under the whole dark sky (8e-4 lux).
constexpr double kDarkGround_cd_m2 = 0.1 * 8e-4 / std::numbers::pi;

}  // namespace

glm::vec3 night_floor_xyz(double elevation_rad, double horizon_elevation_rad, double eye_height_m,
                          bool ground) noexcept {
    const double height_m = std::max(eye_height_m, 0.0);
    if (ground) return glm::vec3{kFloorColour * kDarkGround_cd_m2};
    // Between the dipped horizon and the level the path is as long as along the level.
    const double above_rad = std::max(elevation_rad, 0.5 * (elevation_rad - horizon_elevation_rad));
    const double sine = std::clamp(std::sin(above_rad), 0.0, 1.0);
    const double ratio =
        (kEarthRadius_m + std::min(height_m, kAirglowHeight_m)) / (kEarthRadius_m + kAirglowHeight_m);
    const double van_rhijn = 1.0 / std::sqrt(std::max(1.0 - ratio * ratio * (1.0 - sine * sine), 1e-2));
    const double below_layer = std::clamp((105e3 - height_m) / 20e3, 0.0, 1.0);
    // Rozenberg's air mass: finite at the horizon.
    const double air_mass = 1.0 / (sine + 0.025 * std::exp(-11.0 * sine));
    const double extinction =
        std::pow(10.0, -0.4 * kExtinction_mag * std::exp(-height_m / kScaleHeight_m) * (air_mass - 1.0));
    const double luminance = (kAirglowZenith_cd_m2 * van_rhijn * below_layer + kBeyondAir_cd_m2) * extinction;
    return glm::vec3{kFloorColour * luminance};
}

}  // namespace skyig::render::night
