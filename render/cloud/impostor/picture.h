// One cloud as the eye sees it: its particles shaded, drawn into a picture on a plane through its middle, or
// met by a ray directly.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "render/cloud/cloud_source.h"
#include "render/cloud/impostor/kernels.h"
#include "render/cloud/impostor/light.h"
#include "render/cloud/impostor/particles.h"

namespace skyig::render::cloud::impostor {

/// A particle with its light, from the eye.
struct Shaded {
    Texel colour;  ///< where it is opaque; kDepth_m: its distance
    glm::vec3 place_m;
    float radius_m;
    float optical_depth;
};

/// \param middle_m  of the cloud's box, from the eye \param out  as many as particles, the nearest first
void shade(std::span<const Particle> particles, std::span<const Lit> lit, const Shading& shading,
           const glm::vec3& middle_m, std::span<Shaded> out) noexcept;

/// The same particles' places, laid out for Kernels::halves.
struct Spheres {
    alignas(64) std::array<float, kMostParticles> x;
    std::array<float, kMostParticles> y;
    std::array<float, kMostParticles> z;
    std::array<float, kMostParticles> gap;
    int batches = 0;

    [[nodiscard]] SphereTable table() const noexcept {
        return {x.data(), y.data(), z.data(), gap.data(), batches};
    }
};
void lay_out(std::span<const Shaded> particles, Spheres& spheres) noexcept;

/// The plane that faced the eye when a picture was drawn, fixed to its cloud since.
struct Capture {
    /// From the eye, at the time.
    glm::vec3 middle_m{0.0F};
    glm::vec3 right{1.0F, 0.0F, 0.0F};
    glm::vec3 up{0.0F, 0.0F, 1.0F};
    glm::vec3 away{0.0F, 1.0F, 0.0F};
    /// What there is to see, on the plane, from the middle.
    glm::vec2 low_m{0.0F};
    glm::vec2 high_m{0.0F};
    /// Texels, multiples of kSizeStep; 0 where there is nothing to see.
    glm::ivec2 size{0};
    /// Of the first texel's own corner; and the side of a texel.
    glm::vec2 corner_m{0.0F};
    float texel_m = 1.0F;
    /// How far the cloud reaches before and behind the plane.
    float reach_m = 0.0F;
};

inline constexpr int kSizeStep = 16;

/// A frame round all that is to be seen, with an empty texel round it. \param particles  of one cloud, all
/// before the eye \param texel_rad  that a texel may take \param most  texels along a side
[[nodiscard]] Capture capture_of(std::span<const Shaded> particles, const glm::vec3& middle_m,
                                 float texel_rad, int most) noexcept;

/// The same frame in other texels, square again.
[[nodiscard]] Capture resized(const Capture& capture, glm::ivec2 size) noexcept;

/// \param picture  capture.size texels, row by row from corner_m
void draw(std::span<const Shaded> particles, const Capture& capture, std::span<Texel> picture) noexcept;

/// What all particles make of a ray: the truth that pictures stand for. kDepth_m: distance times opacity.
/// What the eye is inside of counts by the part that lies ahead. \param particles  nearest first \param
/// spheres  laid out of them
[[nodiscard]] Texel meet(std::span<const Shaded> particles, const Spheres& spheres, const glm::vec3& ray,
                         const CloudRange& range) noexcept;

}  // namespace skyig::render::cloud::impostor
