// Clouds of model `impostor` without pictures: a ray meets every particle in its way. What the pictures are
// measured against; too slow to draw.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "render/cloud/cloud_light.h"
#include "render/cloud/cloud_source.h"
#include "render/cloud/impostor/impostor_clouds.h"

namespace skyig::render::cloud::impostor {

class ParticleField final : public CloudSource {
  public:
    /// Allocates. \param clouds  nothing of them is kept \param eye  near the one that they were last updated
    /// for
    ParticleField(const ImpostorClouds& clouds, const CloudLight& light, const Eye& eye);

    /// Rays do not end at the ground.
    void march(std::span<const CloudRay> rays, const CloudRange& range, float ray_rad,
               std::span<CloudSample> out) const noexcept override;

  private:
    struct Placed {
        std::vector<Shaded> shaded;
        Spheres spheres;
        CloudLight::At light;
        glm::vec3 middle_m{0.0F};
        float distance_m = 0.0F;
        float bound_m = 0.0F;
        float part = 1.0F;
    };
    std::vector<std::unique_ptr<Placed>> clouds_;  // nearest first
};

}  // namespace skyig::render::cloud::impostor
