// How the projectors of a rig share the light where they overlap. Free of GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace skyig::render::warp {

/// One value for each pixel of a screen, rows from the lowest, in linear light: what is sent becomes
/// sent * weight * (1 - lift) + lift.
struct Blend {
    int width_px = 0;
    int height_px = 0;
    /// 0..1.
    std::vector<float> weight;
    /// Parts of full white, 0..1: what raises a projector's black to that of several together. One value
    /// stands for all pixels.
    std::vector<float> lift{0.0F};
};

/// Squares of pixels that a blend changes, as triangles: corners in clip space, and their indices.
struct BlendTiles {
    static constexpr int kSide_px = 32;
    std::vector<glm::vec2> corners;
    std::vector<std::uint32_t> indices;
};
[[nodiscard]] BlendTiles changed_tiles(const Blend& blend);

}  // namespace skyig::render::warp
