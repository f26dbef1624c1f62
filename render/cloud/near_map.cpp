#include "render/cloud/near_map.h"

namespace skyig::render::cloud {

NearMap::NearMap() {
    const MapGeometry geometry(kSize);
    map_.resize(geometry, 0);
    constexpr int kAcross = kSize / Snapshot::kPart;
    for (int i = 0; i < 2 * kAcross * kAcross; ++i) {
        const MapGeometry::Texel corner{i % kAcross * Snapshot::kPart,
                                        i / kAcross % kAcross * Snapshot::kPart, i >= kAcross * kAcross};
        parts_.push_back({corner, geometry.cone(corner, Snapshot::kPart)});
    }
}

int NearMap::march(const CloudSource& source, std::span<const ChannelView> views, double margin_rad,
                   const Frozen& frozen) noexcept {
    map_.begin(frozen);
    int rays = 0;
    for (const Part& part : parts_) {
        if (!sees(views, part.cone, margin_rad)) continue;
        map_.march_part(source, part.corner);
        rays += Snapshot::kPart * Snapshot::kPart;
    }
    return rays;
}

}  // namespace skyig::render::cloud
