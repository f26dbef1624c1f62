// The particles that a cloud of model `impostor` is made of (seed 003): a lattice under a dome, a particle
// where noise in space and time passes a threshold. A cloud belongs to a cell of its layer: the same cell and
// seed give the same cloud to everybody.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "render/weather.h"

namespace skyig::render::cloud::impostor {

/// Density falls from the centre as (1 - (r / radius)^2)^2, so that the way past the centre at r has
/// optical_depth * (1 - (r / radius)^2)^(5/2).
struct Particle {
    /// From the middle of the cell's box: east, north, up.
    glm::vec3 centre_m{0.0F};
    float radius_m = 0.0F;
    /// Straight through the centre.
    float optical_depth = 0.0F;
    /// Class of size, < kSizes: key of the light's footprints.
    std::uint32_t key = 0;
};

/// Of any one cloud; half as many make a full-grown one that stands alone.
inline constexpr std::size_t kMostParticles = 1024;

/// What all clouds of one layer have in common, and the footprints that follow from it.
struct CloudShape {
    static constexpr std::uint32_t kSizes = 8;

    /// Side of the square of ground that has one cloud or none, metres: by genus alone, so that clouds stay
    /// where they are while a layer grows.
    double cell_m = 1500.0;
    /// Of a full-grown cloud: half its width, and its height.
    float half_width_m = 800.0F;
    float height_m = 500.0F;
    /// Of the lattice, along each axis.
    float spacing_m = 80.0F;
    /// Of the largest particle.
    float radius_m = 100.0F;
    /// Of a full particle's middle.
    float extinction_per_m = 0.03F;
    /// No particle reaches farther from the middle of the box.
    float bound_m = 1000.0F;

    friend bool operator==(const CloudShape&, const CloudShape&) = default;
};

/// Coverage has no say in it; that makes a cloud grow.
[[nodiscard]] CloudShape shape_of(const CloudLayer& layer) noexcept;

/// Radius of the class `key`.
[[nodiscard]] float class_radius_m(const CloudShape& shape, std::uint32_t key) noexcept;

/// How grown the cloud of a cell is: 0 none, 1 full, up to 2 grown together with its neighbours. \param key
/// of the cell, see cell_key()
[[nodiscard]] float growth(double coverage, std::uint32_t key) noexcept;

/// \param east, north  whole cells from the anchor of the layer
[[nodiscard]] std::uint32_t cell_key(std::int64_t east, std::int64_t north, std::uint32_t seed) noexcept;

/// Where in its cell the cloud stands, 0..1 of the cell's side.
[[nodiscard]] glm::dvec2 place_in_cell(std::uint32_t key) noexcept;

/// \param grown  growth() \param age_s  of the layer's shapes \param out  room for kMostParticles
/// \return how many there are. Sizes and opacities are continuous in `grown` and `age_s`.
[[nodiscard]] std::size_t make_particles(const CloudShape& shape, std::uint32_t key, float grown,
                                         double age_s, std::span<Particle> out) noexcept;

}  // namespace skyig::render::cloud::impostor
