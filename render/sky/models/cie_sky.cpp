#include "render/sky/models/cie_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/sky/azimuth.h"
#include "render/sky/ray_light.h"

namespace skyig::render::sky::models {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr int kOvercastType = 16;

double measured_luminance(double measured_cd_m2, const Surroundings& at, const AirTables& tables,
                          double eye_height_m) {
    if (at.source_elevation_rad() >= 0.0) return measured_cd_m2;
    const Surroundings sunset(tables, eye_height_m, 0.0);
    const float whole = sunset.zenith_xyz().y;
    return whole > 0.0F ? measured_cd_m2 * static_cast<double>(std::min(1.0F, at.zenith_xyz().y / whole))
                        : 0.0;
}

}  // namespace

shaders64::CieSky cie_coefficients(int type) noexcept {
    struct Gradation {
        double a, b;
    };
    struct Indicatrix {
        double c, d, e;
    };
    constexpr std::array<Gradation, 6> kGradations{
        {{4.0, -0.70}, {1.1, -0.80}, {0.0, -1.0}, {-1.0, -0.55}, {-1.0, -0.32}, {-1.0, -0.15}}};
    constexpr std::array<Indicatrix, 6> kIndicatrices{{{0.0, -1.0, 0.0},
                                                       {2.0, -1.5, 0.15},
                                                       {5.0, -2.5, 0.30},
                                                       {10.0, -3.0, 0.45},
                                                       {16.0, -3.0, 0.30},
                                                       {24.0, -2.8, 0.15}}};
    struct Groups {
        std::size_t gradation, indicatrix;
    };
    constexpr std::array<Groups, 15> kTypes{{{0, 0},
                                             {0, 1},
                                             {1, 0},
                                             {1, 1},
                                             {2, 0},
                                             {2, 1},
                                             {2, 2},
                                             {2, 3},
                                             {3, 1},
                                             {3, 2},
                                             {3, 3},
                                             {4, 3},
                                             {4, 4},
                                             {5, 4},
                                             {5, 5}}};
    const Groups& groups = kTypes[static_cast<std::size_t>(std::clamp(type, 1, 15) - 1)];
    const Gradation& g = kGradations[groups.gradation];
    const Indicatrix& f = kIndicatrices[groups.indicatrix];
    return {g.a, g.b, f.c, f.d, f.e};
}

void CieSky::begin(const CieSettings& settings, const AirTables& tables, double eye_height_m,
                   double source_elevation_rad, bool by_sun) noexcept {
    at_ = Surroundings(tables, eye_height_m, source_elevation_rad);
    overcast_ = settings.type >= kOvercastType;
    const shaders64::CieSky sky = cie_coefficients(settings.type);
    sky_ = {static_cast<float>(sky.a), static_cast<float>(sky.b), static_cast<float>(sky.c),
            static_cast<float>(sky.d), static_cast<float>(sky.e)};
    const double sun_zenith = kHalfPi - at_.source_elevation_rad();
    const double zenith_cd_m2 =
        by_sun && settings.zenith_luminance_cd_m2
            ? measured_luminance(*settings.zenith_luminance_cd_m2, at_, tables, eye_height_m)
            : static_cast<double>(at_.zenith_xyz().y);
    const double at_zenith = shaders64::cie_indicatrix(sun_zenith, sky) * shaders64::cie_gradation(1.0, sky);
    scale_ = static_cast<float>(overcast_ ? zenith_cd_m2 : zenith_cd_m2 / at_zenith);
    colour_ = PerezColour(turbidity_of(tables.model()), std::min(sun_zenith, kHalfPi - kLowestFormulaSun_rad),
                          chromaticity_of(at_.zenith_xyz()));
}

glm::vec3 CieSky::xyz_above(float elevation_rad, float relative_azimuth_rad) const noexcept {
    if (!std::isfinite(elevation_rad) || !std::isfinite(relative_azimuth_rad)) return glm::vec3(0.0F);
    const float elevation = clamped_above(at_, elevation_rad);
    const float sine = std::sin(elevation);
    const float sun_angle = shaders32::angle_between(
        elevation, static_cast<float>(at_.source_elevation_rad()), folded_azimuth(relative_azimuth_rad));
    const float relative =
        overcast_ ? shaders32::cie_overcast(sine)
                  : shaders32::cie_indicatrix(sun_angle, sky_) * shaders32::cie_gradation(sine, sky_);
    return colour_.xyz(scale_ * relative, sine, sun_angle);
}

glm::vec3 CieSky::xyz_below(float elevation_rad, float relative_azimuth_rad) const noexcept {
    if (!std::isfinite(elevation_rad) || !std::isfinite(relative_azimuth_rad)) return glm::vec3(0.0F);
    return hazy_ground(at_, clamped_below(at_, elevation_rad),
                       xyz_above(static_cast<float>(at_.horizon_elevation_rad()), relative_azimuth_rad));
}

}  // namespace skyig::render::sky::models
