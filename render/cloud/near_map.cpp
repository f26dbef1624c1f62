#include "render/cloud/near_map.h"

namespace skyig::render::cloud {

NearMap::NearMap() {
    const MapGeometry geometry(kSize);
    map_.resize(geometry, 0);
    for (int tile = 0; tile < geometry.tile_count(); ++tile)
        cones_.push_back(geometry.cone(tile));
}

int NearMap::march(const CloudSource& source, std::span<const ChannelView> views,
                   const Frozen& frozen) noexcept {
    map_.begin(frozen);
    int rays = 0;
    for (int tile = 0; tile < map_.geometry().tile_count(); ++tile) {
        if (!sees(views, cones_[static_cast<std::size_t>(tile)], 0.0)) continue;
        map_.march(source, tile);
        rays += kTileTexels;
    }
    return rays;
}

}  // namespace skyig::render::cloud
