#include "render/night/moon_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/night/moon_map.h"
#include "render/shaders/shared.h"

namespace skyig::render::night {

namespace {
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMeanDistance_km = 384400.0;
constexpr double kLawEnds_rad = 150.0 * kDegree;

// Illuminance by the Lommel-Seeliger function of the same phase, without the difference of waxing and waning.
double light_by_phase_lux(double phase_angle_rad, double distance_km) {
    const double phase_rad = std::min(std::abs(phase_angle_rad), kLawEnds_rad);
    const double a = phase_rad / kDegree;
    const double magnitude =
        -12.73 + 0.026 * a + 4e-9 * a * a * a * a + 5.0 * std::log10(distance_km / kMeanDistance_km);
    const double surge = 1.0 + 0.28 * std::exp(-a / 1.9);
    return 2.54e-6 * std::pow(10.0, -0.4 * magnitude) * surge / shaders64::lommel_seeliger_phase(phase_rad);
}

// Of the waxing Moon above the mean of both, by the Sun's longitude: fits the table of the ROLO model to 0.5
// % up to its end at 97 deg, then fades.
double waxing(double phase_angle_rad, double sun_longitude_rad) {
    return 1.0 + 0.065 * std::pow(std::abs(std::sin(phase_angle_rad)), 0.6) * std::sin(sun_longitude_rad);
}

// Factors of a colour that is redder than sunlight by a difference of B-V, of luminance 1: what happens
// between 440 and 550 nm goes on to 612 nm at half the slope.
glm::dvec3 tint_rgb(double redder_mag) {
    const glm::dvec3 raw{std::pow(10.0, 0.2 * redder_mag), 1.0, std::pow(10.0, -0.32 * redder_mag)};
    return raw / (0.2126 * raw.x + 0.7152 * raw.y + 0.0722 * raw.z);
}

// B-V of the full Moon over the Sun's.
constexpr double kMoonRedder_mag = 0.25;
constexpr double kEarthlightBluer_mag = 0.15;

}  // namespace

double sun_longitude_rad(const Moon& moon) noexcept {
    const glm::dmat3 selenographic_from_enu = glm::transpose(moon.enu_from_selenographic);
    const glm::dvec3 sun = selenographic_from_enu * moon.to_sun_enu;
    const glm::dvec3 eye = selenographic_from_enu * -moon.direction_enu;
    return std::atan2(eye.x * sun.y - eye.y * sun.x, eye.x * sun.x + eye.y * sun.y);
}

double moon_illuminance_lux(double phase_angle_rad, double distance_km, double sun_longitude_rad) noexcept {
    return light_by_phase_lux(phase_angle_rad, distance_km) *
           shaders64::lommel_seeliger_phase(std::abs(phase_angle_rad)) *
           waxing(phase_angle_rad, sun_longitude_rad);
}

double moon_illuminance_lux(const Moon& moon, double sun_distance_au) noexcept {
    return moon_illuminance_lux(moon.phase_angle_rad, moon.distance_km, sun_longitude_rad(moon)) /
           (sun_distance_au * sun_distance_au);
}

double moon_face_cd_m2(const Moon& moon, double sun_distance_au) noexcept {
    const double sine = std::sin(moon.angular_radius_rad);
    const double solid_angle = std::numbers::pi * sine * sine;
    const double longitude_rad = sun_longitude_rad(moon);
    return light_by_phase_lux(moon.phase_angle_rad, moon.distance_km) *
           waxing(moon.phase_angle_rad, longitude_rad) /
           (solid_angle * sun_distance_au * sun_distance_au * moon_map_mean(longitude_rad));
}

double earthshine_cd_m2(double phase_angle_rad) noexcept {
    // Full Earth gives 14 lux on the Moon; the Moon's geometric albedo is 0.12 in retro-reflection.
    constexpr double kFullEarth_lux = 14.0;
    const double phase_of_earth = std::numbers::pi - std::clamp(phase_angle_rad, 0.0, std::numbers::pi);
    return kFullEarth_lux * shaders64::lommel_seeliger_phase(phase_of_earth) * 0.12 / std::numbers::pi;
}

double moon_mean_cd_m2(const Moon& moon, double sun_distance_au) noexcept {
    const double phase_rad = std::clamp(moon.phase_angle_rad, 0.0, std::numbers::pi);
    return moon_face_cd_m2(moon, sun_distance_au) * moon_map_mean(sun_longitude_rad(moon)) *
               shaders64::lommel_seeliger_phase(phase_rad) +
           earthshine_cd_m2(phase_rad);
}

glm::dvec3 moon_tint_rgb() noexcept {
    return tint_rgb(kMoonRedder_mag);
}

glm::dvec3 earthshine_tint_rgb() noexcept {
    return tint_rgb(kMoonRedder_mag - kEarthlightBluer_mag);
}

glm::dvec3 moon_tint_xyz() noexcept {
    const glm::dmat3 xyz_from_rec709 = glm::inverse(kRec709FromXyz);
    return (xyz_from_rec709 * moon_tint_rgb()) / (xyz_from_rec709 * glm::dvec3{1.0});
}

}  // namespace skyig::render::night
