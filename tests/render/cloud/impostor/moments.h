// Weather and light that the impostors' tests share.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/glm.hpp>

#include "render/cloud/cloud_light.h"
#include "render/cloud/impostor/impostor_clouds.h"

namespace skyig::render::cloud::impostor {

inline const glm::vec3 kSunWay = glm::normalize(glm::vec3{0.6F, 0.35F, 0.8F});
inline constexpr float kSun_lx = 1e5F;

/// Sun and sky of a fine day, the same at every height.
inline CloudLight day_light() {
    CloudLight light;
    light.beams[CloudLight::kSun] = {true, kSunWay};
    light.beam_lx[CloudLight::kSun].fill(glm::vec3{kSun_lx, 0.95F * kSun_lx, 0.9F * kSun_lx});
    light.above_cd_m2.fill({3000.0F, 4500.0F, 7500.0F});
    light.below_cd_m2.fill({2500.0F, 2600.0F, 2200.0F});
    return light;
}

/// Scattered cumulus over the eye.
inline Moment fair_weather(double coverage = 0.35) {
    Moment moment;
    moment.eye = {47.3, 8.1, 400.0};
    moment.layer.base_m = 1000.0;
    moment.layer.thickness_m = 700.0;
    moment.layer.coverage = coverage;
    moment.beams = day_light().beams;
    return moment;
}

inline Eye moved_north(const Eye& eye, double metres) {
    Eye moved = eye;
    moved.latitude_deg += metres / 111195.0;
    return moved;
}

/// Of this process, so that others on the machine do not count.
inline double cpu_ms() {
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Display value 0..255 of light before a sky of day, where a white sheet in the Sun is 255.
inline double code(double luminance_cd_m2) {
    const double white = static_cast<double>(kSun_lx) / 3.14159265;
    return 255.0 * std::pow(std::min(1.0, std::max(0.0, luminance_cd_m2 / white)), 1.0 / 2.2);
}
inline constexpr double kSky_cd_m2 = 4500.0;

/// Rays near the Sun are left out where display codes are compared: cloud there is many times as bright as
/// white.
inline bool beside_sun(const CloudRay& ray) {
    return glm::dot(ray.direction_enu, kSunWay) < 0.9F;
}

inline double code(const CloudSample& sample) {
    return code(static_cast<double>(sample.light_cd_m2.y) +
                static_cast<double>(sample.transmittance) * kSky_cd_m2);
}

/// Directions spread evenly over the sphere between two elevations, as sines.
inline CloudRay spread_ray(std::size_t i, std::size_t count, double low, double high) {
    const double z = low + (high - low) * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double turn = 2.399963229728653 * static_cast<double>(i);
    const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {glm::vec3{glm::dvec3{across * std::cos(turn), across * std::sin(turn), z}}};
}

}  // namespace skyig::render::cloud::impostor
