// Cuts a mesh's long triangles where a warp would bend their edges: new vertices in the middle of edges, all
// values linear along them, so that without a warp the same is drawn. Free of GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/dome_patches.h"

namespace skyig::render {

class Refinement {
  public:
    /// Vertices that it adds at most: where that is not enough, edges stay longer.
    static constexpr std::size_t kMostAdded = 24'000;

    /// \param indices  triangles; those with a vertex that is not there are left out \param vertices
    /// `floats` of each, a direction first (unit, or shorter between such) \param longest_rad  of an edge
    void refine(std::span<const std::uint32_t> indices, std::span<const float> vertices, std::size_t floats,
                double longest_rad);

    /// The triangles, in the order of those that they are parts of.
    [[nodiscard]] std::span<const std::uint32_t> indices() const noexcept { return indices_; }
    /// What a run of the first indices has become.
    [[nodiscard]] IndexRange range(const IndexRange& range) const noexcept;
    /// The added vertices, to stand after the others. Valid until the next call.
    [[nodiscard]] std::span<const float> added(std::span<const float> vertices, std::size_t floats);

  private:
    struct Middle {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
    };
    bool refine_to(std::span<const std::uint32_t> indices, std::span<const float> vertices,
                   std::size_t floats, double longest);
    [[nodiscard]] std::uint32_t middle_of(std::uint32_t a, std::uint32_t b);
    void cut(std::uint32_t a, std::uint32_t b, std::uint32_t c, double longest_squared);
    [[nodiscard]] double length_squared(std::uint32_t a, std::uint32_t b) const noexcept;

    std::vector<std::uint32_t> indices_;
    std::vector<std::size_t> first_of_triangle_;
    std::vector<Middle> middles_;
    std::vector<std::uint32_t> slots_;  // of a hash table: number of a middle + 1
    std::vector<float> directions_;     // three of each vertex
    std::vector<float> added_;
    std::uint32_t vertex_count_ = 0;
};

}  // namespace skyig::render
