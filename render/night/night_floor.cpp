#include "render/night/night_floor.h"

#include <algorithm>
#include <cmath>

#include "render/geometry.h"

namespace skyig::render::night {

namespace {

constexpr double kAirglowHeight_m = 90e3;
constexpr double kExtinction_mag = 0.17;
constexpr double kScaleHeight_m = 8e3;

// XYZ of a star of B-V 1.0, the colour index of the dark sky.
constexpr glm::dvec3 kFloorColour{0.986, 1.0, 0.811};

// Of the light that the air takes from a ray it gives this part back from all around: the sky is everywhere.
constexpr double kScatteredBack = 0.6;

double part_that_passes(double air_mass) {
    return std::pow(10.0, -0.4 * kExtinction_mag * air_mass);
}

}  // namespace

glm::vec3 night_floor_xyz(double elevation_rad, double horizon_elevation_rad, double eye_height_m,
                          bool ground, double ground_cd_m2) noexcept {
    const double height_m = std::max(eye_height_m, 0.0);
    const double thinned = std::exp(-height_m / kScaleHeight_m);
    // Between the dipped horizon and the level the path is as long as along the level.
    const double above_rad = ground ? horizon_elevation_rad - elevation_rad
                                    : std::max(elevation_rad, 0.5 * (elevation_rad - horizon_elevation_rad));
    const double sine = std::clamp(std::sin(above_rad), 0.0, 1.0);
    // Rozenberg's air mass: finite at the horizon.
    const double air_mass = 1.0 / (sine + 0.025 * std::exp(-11.0 * sine));
    const double scattered = kScatteredBack * (kAirglowZenith_cd_m2 + kBeyondAir_cd_m2);
    if (ground) {
        const double passes = part_that_passes((1.0 - thinned) * air_mass);
        return glm::vec3{kFloorColour * (ground_cd_m2 * passes + scattered * (1.0 - passes))};
    }
    const double ratio =
        (kEarthRadius_m + std::min(height_m, kAirglowHeight_m)) / (kEarthRadius_m + kAirglowHeight_m);
    const double van_rhijn = 1.0 / std::sqrt(std::max(1.0 - ratio * ratio * (1.0 - sine * sine), 1e-2));
    const double below_layer = std::clamp((105e3 - height_m) / 20e3, 0.0, 1.0);
    const double passes = part_that_passes(thinned * (air_mass - 1.0));
    const double beyond = kAirglowZenith_cd_m2 * van_rhijn * below_layer + kBeyondAir_cd_m2;
    return glm::vec3{kFloorColour * (beyond * passes + scattered * (1.0 - passes))};
}

}  // namespace skyig::render::night
