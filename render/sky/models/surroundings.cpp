#include "render/sky/models/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sky/air_data.h"
#include "render/sky/ray_light.h"

namespace skyig::render::sky::models {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kLowestEyeM = 0.01;
constexpr double kFarthestEyeM = 1e9;
constexpr std::size_t kGreen = 8;  // 558 nm

// Of molecules and aerosol between a height and the lid.
double vertical_depth(const AirModel& air, double height_m) {
    if (height_m >= air.top_height_m) return 0.0;
    const double molecules_m =
        column_above_m(air.molecules, height_m) - column_above_m(air.molecules, air.top_height_m);
    const double scale_m = air.aerosol_scale_height_m;
    const double aerosol_m =
        scale_m * (std::exp(-height_m / scale_m) - std::exp(-air.top_height_m / scale_m));
    return static_cast<double>(air.rayleigh_per_m[kGreen]) * molecules_m +
           static_cast<double>(air.aerosol_extinction_per_m[kGreen]) * aerosol_m;
}

// Mean of exp(-z / scale) over 0..height.
double mean_density(double height_m, double scale_m) {
    const double x = height_m / scale_m;
    return x < 1e-3 ? 1.0 - 0.5 * x : -std::expm1(-x) / x;
}

}  // namespace

Surroundings::Surroundings(const AirTables& tables, double eye_height_m, double source_elevation_rad) noexcept
    : eye_height_m_(std::isfinite(eye_height_m) ? std::clamp(eye_height_m, kLowestEyeM, kFarthestEyeM)
                                                : kLowestEyeM),
      source_elevation_rad_(std::isfinite(source_elevation_rad)
                                ? std::clamp(source_elevation_rad, -kHalfPi, kHalfPi)
                                : -kHalfPi),
      shell_(tables.data().shell) {
    horizon_rad_ = -shell_.dip_rad(eye_height_m_);
    RayQuery up;
    up.eye_height_m = eye_height_m_;
    up.source_elevation_rad = source_elevation_rad_;
    up.elevation_rad = kHalfPi;
    zenith_xyz_ = glm::vec3(ray_light(tables, up).xyz);
    RayQuery down = up;
    down.eye_height_m = kLowestEyeM;
    down.elevation_rad = -kHalfPi;
    ground_xyz_ = glm::vec3(ray_light(tables, down).xyz);
    const AirModel& model = tables.model();
    const double all = vertical_depth(model, 0.0);
    air_above_ = all > 0.0 ? std::clamp(vertical_depth(model, eye_height_m_) / all, 0.0, 1.0) : 0.0;
    constexpr double kMoleculesM = 8000.0;
    extinction_per_m_ =
        static_cast<double>(model.rayleigh_per_m[kGreen]) * mean_density(eye_height_m_, kMoleculesM) +
        static_cast<double>(model.aerosol_extinction_per_m[kGreen]) *
            mean_density(eye_height_m_, model.aerosol_scale_height_m);
}

double Surroundings::fade_below(const AirTables& tables, double last_rad) const noexcept {
    if (source_elevation_rad_ >= last_rad) return 1.0;
    const double whole = tables.ground_diffuse_xyz(last_rad).y;
    return whole > 0.0 ? std::min(1.0, tables.ground_diffuse_xyz(source_elevation_rad_).y / whole) : 0.0;
}

double Surroundings::ground_distance_m(float elevation_rad) const noexcept {
    const double sine =
        std::min(std::sin(static_cast<double>(elevation_rad)), -shell_.dip_sine(eye_height_m_));
    return shell_.distance_to_ground_m(eye_height_m_, sine);
}

float Surroundings::ground_share(float elevation_rad) const noexcept {
    return static_cast<float>(std::exp(-extinction_per_m_ * ground_distance_m(elevation_rad)));
}

glm::vec3 hazy_ground(const Surroundings& at, float elevation_rad, const glm::vec3& horizon_xyz) noexcept {
    const float share = at.ground_share(elevation_rad);
    return horizon_xyz + share * (at.ground_xyz() - horizon_xyz);
}

float clamped_above(const Surroundings& at, float elevation_rad) noexcept {
    return std::clamp(elevation_rad, static_cast<float>(at.horizon_elevation_rad()),
                      static_cast<float>(kHalfPi));
}

float clamped_below(const Surroundings& at, float elevation_rad) noexcept {
    return std::clamp(elevation_rad, -static_cast<float>(kHalfPi),
                      static_cast<float>(at.horizon_elevation_rad()));
}

}  // namespace skyig::render::sky::models
