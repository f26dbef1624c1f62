// A PFM file (portable float map): a text header, then rows of 32-bit floats from the lowest.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "config/warp/maps.h"

namespace skyig::config::warp {

struct FloatMap {
    int width = 0;
    int height = 0;
    /// 3 (PF) or 1 (Pf).
    int components = 0;
    /// All finite.
    std::vector<float> values;
};

/// Either byte order. Sides of 1..16384; the data must be as long as the header says.
[[nodiscard]] FileRead<FloatMap> read_float_map(std::span<const std::byte> bytes);

/// A map of two or more components as a warp; denser ones are thinned to kMostWarpNodes a side. Refuses fewer
/// nodes than 2 x 2, places beyond -0.5..1.5, and cells that fold over.
[[nodiscard]] FileRead<WarpMesh> warp_mesh(const FloatMap& map, bool at_edges);

}  // namespace skyig::config::warp
