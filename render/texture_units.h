// Texture units that stay bound while passes with units of their own draw: the one place that gives them out.
// The shaders name the same numbers in their `layout(binding = ...)`. Units 0 to 7 belong to the pass that
// draws, which binds them anew.
#pragma once

#include <array>
#include <cstddef>

namespace skyig::render::texture_unit {

inline constexpr int kFirst = 8;
/// Three maps of the clouds before and behind things, in the order of cloud/things.glsl.
inline constexpr int kThingClouds = 8;
inline constexpr int kThingCloudCount = 3;
/// Shadows of clouds on things, fog patches before them: cloud/things.glsl.
inline constexpr int kThingShadow = kThingClouds + kThingCloudCount;
inline constexpr int kThingPatches = 12;
/// What a channel's warp does, for a whole channel: common/place.glsl.
inline constexpr int kWarp = 13;

inline constexpr std::array kUnits{kThingClouds, kThingClouds + 1, kThingClouds + 2,
                                   kThingShadow, kThingPatches,    kWarp};
/// What GL 4 grants every stage.
inline constexpr int kGranted = 16;

constexpr bool each_is_used_once() {
    for (std::size_t i = 0; i < kUnits.size(); ++i) {
        if (kUnits[i] < kFirst || kUnits[i] >= kGranted) return false;
        for (std::size_t k = 0; k < i; ++k)
            if (kUnits[i] == kUnits[k]) return false;
    }
    return true;
}
static_assert(each_is_used_once());

}  // namespace skyig::render::texture_unit
