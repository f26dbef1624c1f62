// The slab models' table of light inside clouds, in the form that the march fetches fast.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cloud/field/kernels.h"

namespace skyig::render::cloud::field {

/// InsideTable (slab_table.h) for clouds of one asymmetry: each node's four terms as 16-bit parts of what
/// each of them spans (error below 1e-5 of that), two an entry.
class InsideLight {
  public:
    explicit InsideLight(float g);

    /// Refers to this.
    [[nodiscard]] SlabNodes nodes() const noexcept;

  private:
    std::vector<std::uint32_t> entries_;
    SlabNodes told_{};
};

}  // namespace skyig::render::cloud::field
