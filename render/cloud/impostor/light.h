// Light on the particles of one cloud: a small picture of the light that is left, drawn particle by particle
// away from the source, each taking its share of what the next ones get (Harris & Lastra, "Real-Time Cloud
// Rendering", Eurographics 2001; the light stays on the CPU). Other clouds cast no shadow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/cloud/cloud_light.h"
#include "render/cloud/impostor/kernels.h"
#include "render/cloud/impostor/particles.h"
#include "render/cloud/slab_light.h"

namespace skyig::render::cloud::impostor {

enum class LightMethod : std::uint8_t {
    kProduct,  ///< seed 003, first: what all particles before let through; Rayleigh phase
    kGather,   ///< seed 003, second: and what they scatter on within a narrow cone
    kDepths,  ///< the buffer tells how much cloud lies towards source, sky and ground; CloudScatter the light
};

/// What reaches a particle's centre.
struct Lit {
    /// Of each source: part of its light, 0..1; by kDepths: optical depth on the way to it.
    std::array<float, CloudLight::kSources> beams{};
    /// Optical depths straight up and down; like those to the sources no less than half of its own.
    float above = 0.0F;
    float below = 0.0F;
};

/// How all clouds are shaded in one frame.
class Shading {
  public:
    Shading(LightMethod method, const std::array<Beam, CloudLight::kSources>& beams) noexcept;

    [[nodiscard]] LightMethod method() const noexcept { return method_; }
    [[nodiscard]] const std::array<Beam, CloudLight::kSources>& beams() const noexcept { return beams_; }

    /// What an opaque particle sends to the eye. \param ray  unit vector from the eye to it
    [[nodiscard]] Texel colour(const Lit& lit, const glm::vec3& ray) const noexcept;

  private:
    LightMethod method_;
    std::array<Beam, CloudLight::kSources> beams_;
    std::array<CloudScatter, CloudLight::kSources> scatter_;
};

/// 64 x 64 x 16 bits: with 8 bits a particle that takes 1/50 of the light stops changing what is dark.
class LightBuffer {
  public:
    static constexpr int kSide = 64;

    LightBuffer();

    /// Fills `lit`, one for each particle. \param shape  that the particles were made with
    void light(const CloudShape& shape, std::span<const Particle> particles, const Shading& shading,
               std::span<Lit> lit) noexcept;

  private:
    enum class Meaning : std::uint8_t { kPart, kGathered, kDepth };
    void prepare(const CloudShape& shape) noexcept;
    /// Sends light from `towards` through the particles; `out` tells what reaches each.
    template <class Out>
    void trace(std::span<const Particle> particles, std::span<const std::uint16_t> order,
               const glm::vec3& towards, Meaning meaning, const Out& out) noexcept;
    /// Away from `towards`.
    [[nodiscard]] std::span<const std::uint16_t> ordered(std::span<const Particle> particles,
                                                         const glm::vec3& towards) noexcept;

    static constexpr int kStride = kSide + 2 * kStampSide;
    std::vector<std::uint16_t> light_;
    std::array<std::array<std::uint16_t, kStampSide * kStampSide>, CloudShape::kSizes> masks_{};
    CloudShape shape_;
    float texels_per_m_ = 0.0F;
    std::array<float, kMostParticles> keys_{};
    std::array<std::uint16_t, kMostParticles> order_{};
};

}  // namespace skyig::render::cloud::impostor
