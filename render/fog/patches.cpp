#include "render/fog/patches.h"

#include <algorithm>

#include "render/weather_ramp.h"

namespace skyig::render::fog {

namespace {

/// Over these depths patches go over into their mean. Fog that lies in patches is tens of metres deep;
/// followed ray by ray, one of kilometres holds a frame up for seconds.
constexpr double kShallow_m = 400.0;
constexpr double kDeep_m = 600.0;

}  // namespace

PatchedFog in_patches(const Obscurant& obscurant, double ground_m) noexcept {
    PatchedFog fog{obscurant, {}};
    fog.patches.coverage = 0.0;
    const double coverage = std::clamp(obscurant.coverage, 0.0, 1.0);
    const double base_m = std::max(obscurant.base_m, ground_m);
    const bool stands = obscurant.kind == Obscurant::Kind::kFog && obscurant.extinction_per_m > 0.0 &&
                        obscurant.top_m > base_m;
    if (!stands || coverage >= 1.0) return fog;
    // The last gaps, which the ramp of coverage gives most of its time.
    const double even = std::max(coverage - CoverScale::kLast, 0.0) / (1.0 - CoverScale::kLast);
    const double depth_m = obscurant.top_m + obscurant.top_band_m - base_m;
    const double mean = std::clamp((depth_m - kShallow_m) / (kDeep_m - kShallow_m), 0.0, 1.0);
    fog.even.extinction_per_m = (even + (1.0 - even) * mean * coverage) * obscurant.extinction_per_m;
    fog.even.coverage = 1.0;
    if (mean >= 1.0) return fog;
    CloudLayer& patches = fog.patches;
    patches.genus = CloudGenus::kFogPatches;
    patches.base_m = base_m;
    patches.thickness_m = obscurant.top_m - base_m;
    patches.bottom_band_m = base_m > ground_m ? obscurant.bottom_band_m : 0.0;
    patches.top_band_m = obscurant.top_band_m;
    patches.coverage = coverage;
    patches.extinction_per_m = (1.0 - even) * (1.0 - mean) * obscurant.extinction_per_m;
    patches.drift_m = obscurant.drift_m;
    patches.seed = obscurant.seed;
    patches.area = obscurant.area;
    return fog;
}

}  // namespace skyig::render::fog
