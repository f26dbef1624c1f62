// One layer under a plain light, and rays to look at it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include "render/cloud/field/cloud_field.h"

namespace skyig::render::cloud::field {

inline constexpr double kPi = std::numbers::pi;

/// Made once for all tests of a program.
inline std::shared_ptr<const Matrix> matrix() {
    static const auto kMatrix = std::make_shared<const Matrix>();
    return kMatrix;
}

/// The Sun of 1000 lx at this elevation in the south, under a sky of 100 cd/m2, over ground of 50.
inline CloudLight plain_light(double elevation_rad = 0.8) {
    CloudLight light;
    light.beams[CloudLight::kSun] = {true, glm::vec3(0.0F, static_cast<float>(-std::cos(elevation_rad)),
                                                     static_cast<float>(std::sin(elevation_rad)))};
    light.beam_lx[CloudLight::kSun].fill(glm::vec3(1000.0F));
    light.above_cd_m2.fill(glm::vec3(100.0F));
    light.below_cd_m2.fill(glm::vec3(50.0F));
    return light;
}

/// The Sun alone.
inline CloudLight beam_light(double elevation_rad) {
    CloudLight light = plain_light(elevation_rad);
    light.above_cd_m2.fill(glm::vec3(0.0F));
    light.below_cd_m2.fill(glm::vec3(0.0F));
    return light;
}

inline CloudLayer layer_of(CloudGenus genus, double base_m, double thickness_m, double coverage) {
    CloudLayer layer;
    layer.genus = genus;
    layer.model = CloudModel::kVolume;
    layer.base_m = base_m;
    layer.thickness_m = thickness_m;
    layer.coverage = coverage;
    layer.seed = 3;
    return layer;
}

/// The layer that has the same everywhere.
inline CloudLayer slab_of(double base_m, double thickness_m, double depth) {
    CloudLayer layer = layer_of(CloudGenus::kStratus, base_m, thickness_m, 1.0);
    layer.extinction_per_m = depth / thickness_m;
    return layer;
}

inline Scene scene_of(std::initializer_list<CloudLayer> layers, double eye_m) {
    Scene scene;
    scene.eye = {46.5, 7.9, eye_m};
    for (const CloudLayer& layer : layers)
        scene.weather.clouds[scene.weather.cloud_count++] = layer;
    return scene;
}

inline CloudRay ray_at(double elevation_rad, double azimuth_rad) {
    return {glm::vec3(glm::dvec3(std::sin(azimuth_rad) * std::cos(elevation_rad),
                                 std::cos(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad)))};
}

/// Over the whole sphere, or from `lowest` to `highest` elevation.
inline std::vector<CloudRay> sphere_of_rays(int rows, int columns, double lowest = -0.5 * kPi,
                                            double highest = 0.5 * kPi) {
    std::vector<CloudRay> rays;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column)
            rays.push_back(
                ray_at(lowest + (highest - lowest) * (row + 0.5) / rows, 2.0 * kPi * column / columns));
    }
    return rays;
}

inline constexpr float kRay_rad = 2e-3F;

inline std::vector<CloudSample> seen(const CloudSource& source, const std::vector<CloudRay>& rays,
                                     const CloudRange& range = {}, float ray_rad = kRay_rad) {
    std::vector<CloudSample> samples(rays.size());
    source.march(rays, range, ray_rad, samples);
    return samples;
}

inline std::vector<CloudSample> seen(const Scene& scene, const CloudLight& light,
                                     const std::vector<CloudRay>& rays, const CloudRange& range = {}) {
    CloudField field(matrix());
    field.freeze(scene, light);
    return seen(field, rays, range);
}

inline bool is_sound(const CloudSample& sample) {
    const glm::vec3& light = sample.light_cd_m2;
    return std::isfinite(light.x + light.y + light.z) && light.x >= 0.0F && light.y >= 0.0F &&
           light.z >= 0.0F && sample.transmittance >= 0.0F && sample.transmittance <= 1.0F &&
           std::isfinite(sample.distance_m) && sample.distance_m >= 0.0F;
}

inline std::vector<const Kernels*> variants() {
    std::vector<const Kernels*> found = {&portable::kernels()};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back(&avx2::kernels());
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
        found.push_back(&avx512::kernels());
    }
#endif
    return found;
}

/// As eyes compare it: of two samples in front of a sky of 100 cd/m2, in 255ths of the brighter one or of
/// white cloud in that light.
inline double step_255(const CloudSample& a, const CloudSample& b) {
    const float one = a.light_cd_m2.y + a.transmittance * 100.0F;
    const float other = b.light_cd_m2.y + b.transmittance * 100.0F;
    return 255.0 * static_cast<double>(std::abs(one - other) / std::max({one, other, 400.0F}));
}

}  // namespace skyig::render::cloud::field
