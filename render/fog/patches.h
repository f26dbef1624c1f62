// Fog with gaps, as it is drawn: patches that stand on the ground, followed like a cloud ray by ray. What is
// all but closed goes over into even fog.
#pragma once

#include "render/weather.h"

namespace skyig::render::fog {

/// One layer of fog in two parts, whose extinctions add up to its own in the middle of a patch while that is
/// shallow; deep fog, of 600 m, is even with the mean of its coverage.
struct PatchedFog {
    /// Covers all; 0 extinction: none of it.
    Obscurant even;
    /// Of genus kFogPatches; 0 coverage: none.
    CloudLayer patches;
};

/// Fog with coverage below 1. Other obscurants and whole coverage stay even; obscurants whose single
/// scattering absorbs are not drawn as clouds. \param ground_m  where it ends below
[[nodiscard]] PatchedFog in_patches(const Obscurant& obscurant, double ground_m) noexcept;

}  // namespace skyig::render::fog
