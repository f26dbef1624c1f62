#include "render/warp/blend.h"

#include <algorithm>
#include <cstddef>

namespace skyig::render::warp {

namespace {

bool changes(const Blend& blend, int left, int bottom, int right, int top) {
    for (int y = bottom; y < top; ++y) {
        for (int x = left; x < right; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(blend.width_px) +
                           static_cast<std::size_t>(x);
            if (blend.weight[i] != 1.0F || blend.lift[blend.lift.size() == 1 ? 0 : i] != 0.0F) return true;
        }
    }
    return false;
}

}  // namespace

BlendTiles changed_tiles(const Blend& blend) {
    BlendTiles tiles;
    const glm::vec2 size{blend.width_px, blend.height_px};
    for (int bottom = 0; bottom < blend.height_px; bottom += BlendTiles::kSide_px) {
        for (int left = 0; left < blend.width_px; left += BlendTiles::kSide_px) {
            const int right = std::min(left + BlendTiles::kSide_px, blend.width_px);
            const int top = std::min(bottom + BlendTiles::kSide_px, blend.height_px);
            if (!changes(blend, left, bottom, right, top)) continue;
            const auto first = static_cast<std::uint32_t>(tiles.corners.size());
            for (const auto& corner : {glm::vec2{left, bottom}, glm::vec2{right, bottom},
                                       glm::vec2{left, top}, glm::vec2{right, top}})
                tiles.corners.push_back(2.0F * corner / size - 1.0F);
            for (const std::uint32_t i : {0U, 1U, 2U, 2U, 1U, 3U})
                tiles.indices.push_back(first + i);
        }
    }
    return tiles;
}

}  // namespace skyig::render::warp
