// A mesh of directions as one or more channels draw it: as it is, or cut finer where a warp bends its edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <span>

#include "render/dome_patches.h"
#include "render/gl/mesh.h"
#include "render/refinement.h"

namespace skyig::render {

class RefinedMesh {
  public:
    /// \param components  floats of each vertex attribute, the first a direction \param refines  whether
    /// channels are warped
    RefinedMesh(std::initializer_list<int> components, std::size_t max_vertices, bool refines)
        : floats_(static_cast<std::size_t>(std::accumulate(components.begin(), components.end(), 0))),
          refines_(refines),
          mesh_(components, max_vertices + (refines ? Refinement::kMostAdded : 0)) {}

    /// Takes over triangles and all vertices. \param longest_rad  of an edge
    void set_triangles(std::span<const std::uint32_t> indices, std::span<const float> vertices,
                       double longest_rad) {
        if (refines_) refinement_.refine(indices, vertices, floats_, longest_rad);
        mesh_.set_indices(refines_ ? refinement_.indices() : indices);
        set_vertices(vertices);
    }
    /// As many as set_triangles() had.
    void set_vertices(std::span<const float> vertices) {
        mesh_.update(vertices);
        if (refines_) mesh_.update(refinement_.added(vertices, floats_), vertices.size() / floats_);
    }
    /// \param range  of the indices that set_triangles() was given
    void draw(const IndexRange& range) const {
        const IndexRange drawn = refines_ ? refinement_.range(range) : range;
        mesh_.draw_triangles(drawn.first, drawn.count);
    }

  private:
    std::size_t floats_;
    bool refines_;
    gl::Mesh mesh_;
    Refinement refinement_;
};

}  // namespace skyig::render
