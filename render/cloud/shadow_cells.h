// Shadows on the ground as the hot loops read them. Plain data only: see tile_tone.h.
#pragma once

namespace skyig::render::cloud {

/// Squares one round the other, of so many cells on a side.
inline constexpr int kShadowLevels = 3;
inline constexpr int kShadowSide = 128;
/// A square fades into the next one over this part of its side.
inline constexpr float kShadowFade = 8.0F / kShadowSide;
/// Looks along the stretch of ground that a ray's angle stands for, at most.
inline constexpr int kShadowLooks = 6;
/// They lie no closer than this part of the way to the middle, nor than a cell.
inline constexpr float kShadowApart = 0.01F;

/// Part of the beam that comes to each cell, and the round ground that a ray meets (GroundShadow::meets()).
struct ShadowCells {
    const float* passed;  ///< a square after the other, the southernmost row first
    float corner_m[kShadowLevels][2];
    float inverse_cell_m[kShadowLevels];
    float least_cell_m;
    float mean;
    float reach_m;
    float ray_rad;  ///< the angle of a texel
    float excess_m, excess, level_share;
};

}  // namespace skyig::render::cloud
