#include "render/cloud/impostor/particle_field.h"

#include <algorithm>

namespace skyig::render::cloud::impostor {

ParticleField::ParticleField(const ImpostorClouds& clouds, const CloudLight& light, const Eye& eye) {
    const auto range = static_cast<float>(clouds.range_m());
    for (const Cloud& cloud : clouds.clouds()) {
        const glm::vec3 middle{clouds.middle_m(cloud, eye)};
        const float distance = glm::length(middle);
        if (cloud.particles == 0 || distance >= range) continue;
        auto placed = std::make_unique<Placed>();
        placed->shaded.resize(cloud.particles);
        shade(clouds.particles(cloud), clouds.lit(cloud), clouds.shading(), middle, placed->shaded);
        lay_out(placed->shaded, placed->spheres);
        placed->light =
            light.at(clouds.moment().layer.base_m + 0.5 * static_cast<double>(cloud.shape.height_m));
        placed->middle_m = middle;
        placed->distance_m = distance;
        placed->bound_m = cloud.bound_m;
        placed->part = shown_part(distance, range);
        clouds_.push_back(std::move(placed));
    }
    std::sort(clouds_.begin(), clouds_.end(),
              [](const auto& a, const auto& b) { return a->distance_m < b->distance_m; });
}

void ParticleField::march(std::span<const CloudRay> rays, const CloudRange& range, float /*ray_rad*/,
                          std::span<CloudSample> out) const noexcept {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::vec3& ray = rays[i].direction_enu;
        CloudSample sample;
        float weighed_m = 0.0F;
        for (const auto& cloud : clouds_) {
            const float along = glm::dot(ray, cloud->middle_m);
            const float beside2 = cloud->distance_m * cloud->distance_m - along * along;
            if (along < -cloud->bound_m || beside2 > cloud->bound_m * cloud->bound_m) continue;
            const Texel texel = meet(cloud->shaded, cloud->spheres, ray, range);
            const float part = sample.transmittance * cloud->part;
            const CloudLight::At& light = cloud->light;
            sample.light_cd_m2 +=
                part * (texel.v[kSunlight] * light.beam_lx[CloudLight::kSun] +
                        texel.v[kMoonlight] * light.beam_lx[CloudLight::kMoon] +
                        texel.v[kFromAbove] * light.above_cd_m2 + texel.v[kFromBelow] * light.below_cd_m2);
            weighed_m += part * texel.v[kDepth_m];
            sample.transmittance *= 1.0F - cloud->part * texel.v[kOpacity];
        }
        if (sample.transmittance < 1.0F) sample.distance_m = weighed_m / (1.0F - sample.transmittance);
        out[i] = sample;
    }
}

}  // namespace skyig::render::cloud::impostor
