#include "render/night/moon_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/shaders/shared.h"

namespace skyig::render::night {

namespace {
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMeanDistance_km = 384400.0;
constexpr double kLawEnds_rad = 160.0 * kDegree;
}  // namespace

double moon_illuminance_lux(double phase_angle_rad, double distance_km) noexcept {
    const double a = std::abs(phase_angle_rad) / kDegree;
    const double magnitude =
        -12.73 + 0.026 * a + 4e-9 * a * a * a * a + 5.0 * std::log10(distance_km / kMeanDistance_km);
    const double surge = a < 7.0 ? 1.35 - 0.05 * a : 1.0;
    return 2.54e-6 * std::pow(10.0, -0.4 * magnitude) * surge;
}

double moon_face_cd_m2(const Moon& moon) noexcept {
    const double phase = std::min(moon.phase_angle_rad, kLawEnds_rad);
    const double sine = std::sin(moon.angular_radius_rad);
    const double solid_angle = std::numbers::pi * sine * sine;
    return moon_illuminance_lux(phase, moon.distance_km) / solid_angle /
           shaders64::lommel_seeliger_phase(phase);
}

double earthshine_cd_m2(double phase_angle_rad) noexcept {
    // Full Earth gives 14 lux on the Moon; the Moon's geometric albedo is 0.12 in retro-reflection.
    constexpr double kFullEarth_lux = 14.0;
    const double phase_of_earth = std::numbers::pi - std::clamp(phase_angle_rad, 0.0, std::numbers::pi);
    return kFullEarth_lux * shaders64::lommel_seeliger_phase(phase_of_earth) * 0.12 / std::numbers::pi;
}

glm::dvec3 moon_tint_rgb() noexcept {
    // 0.25 mag of B-V between 440 and 550 nm, carried on to 612 nm; luminance stays.
    const glm::dvec3 raw{1.12, 1.0, 0.83};
    return raw / (0.2126 * raw.x + 0.7152 * raw.y + 0.0722 * raw.z);
}

glm::dvec3 moon_tint_xyz() noexcept {
    const glm::dmat3 xyz_from_rec709 = glm::inverse(kRec709FromXyz);
    return (xyz_from_rec709 * moon_tint_rgb()) / (xyz_from_rec709 * glm::dvec3{1.0});
}

}  // namespace skyig::render::night
