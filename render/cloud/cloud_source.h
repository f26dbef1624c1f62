// What the cloud map asks of anything that draws clouds.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <span>

namespace skyig::render::cloud {

/// What clouds make of the light along a ray: seen = light_cd_m2 + transmittance * what lies behind.
struct CloudSample {
    /// Linear Rec.709, dimmed by other cloud before it but not by the air: that is laid over it by its
    /// distance.
    glm::vec3 light_cd_m2{0.0F};
    /// Of the clouds alone, 0..1.
    float transmittance = 1.0F;
    /// Mean distance of what the clouds add, by its share of the opacity, metres; 0 where there is none.
    float distance_m = 0.0F;

    friend bool operator==(const CloudSample&, const CloudSample&) = default;
};

/// A ray to be followed, from the one eye that a source was made for.
struct CloudRay {
    /// Unit vector, east-north-up, as a straight ray (without refraction).
    glm::vec3 direction_enu{0.0F, 0.0F, 1.0F};
};

struct CloudRange {
    float from_m = 0.0F;
    float to_m = 1e7F;
};

/// A source of parallel light, as good as.
struct CloudBeam {
    /// Towards it, unit vector, above the horizon, as a straight ray.
    glm::vec3 direction_enu{0.0F, 0.0F, 1.0F};
    /// Angle of its disc.
    float spread_rad = 0.0F;
};

/// One frozen moment: eye, layers and light do not change. Answers depend on the ray alone, not on which rays
/// are asked together or on which thread.
class CloudSource {
  public:
    virtual ~CloudSource() = default;

    /// \param rays  \param out  as many \param ray_rad  angle that a ray stands for: what is finer is left
    /// out rather than sampled by chance. Never throws, allocates nothing; every sample is finite, light >=
    /// 0. A ray that meets no cloud gives exactly {0, 1, 0}. Rays end at the ground.
    virtual void march(std::span<const CloudRay> rays, const CloudRange& range, float ray_rad,
                       std::span<CloudSample> out) const noexcept = 0;

    /// What clouds leave of a beam, scattered light apart, at places on the ground: east and north of below
    /// the eye. \param grain_m  what is finer does not show \param passed  as many as places, 0..1. A source
    /// that knows no better casts no shadow.
    virtual void shadow(const CloudBeam& /*beam*/, float /*grain_m*/, std::span<const glm::vec2> /*ground_m*/,
                        std::span<float> passed) const noexcept {
        std::fill(passed.begin(), passed.end(), 1.0F);
    }

  protected:
    CloudSource() = default;
    CloudSource(const CloudSource&) = default;
    CloudSource& operator=(const CloudSource&) = default;
    CloudSource(CloudSource&&) = default;
    CloudSource& operator=(CloudSource&&) = default;
};

}  // namespace skyig::render::cloud
