#include "render/cloud/impostor/atlas.h"

#include <algorithm>

#include "render/cloud/impostor/atlas_rectangles.h"
#include "render/cloud/impostor/atlas_tiles.h"
#include "render/cloud/impostor/picture.h"

namespace skyig::render::cloud::impostor {

std::unique_ptr<Atlas> Atlas::make(const AtlasSettings& settings) {
    if (settings.scheme == AtlasScheme::kTiles) return std::make_unique<TileAtlas>(settings);
    return std::make_unique<RectangleAtlas>(settings);
}

Atlas::Atlas(const AtlasSettings& settings)
    : settings_(settings),
      texels_(static_cast<std::size_t>(settings.size.x) * static_cast<std::size_t>(settings.size.y)),
      sizes_(static_cast<std::size_t>(settings.pictures), glm::ivec2{0}) {
    for (Id id = settings.pictures; id-- > 0;)
        free_ids_.push_back(id);
}

Atlas::Id Atlas::allocate(glm::ivec2 wanted) noexcept {
    if (free_ids_.empty()) return kNone;
    const Id id = free_ids_.back();
    // From the longer side, step by step, so that the aspect stays nearly as it was.
    const int longer = std::max(wanted.x, wanted.y);
    for (int side = longer; side >= kSizeStep; side -= kSizeStep) {
        const auto shorter = [&](int n) {
            const int scaled = (n * side + longer / 2) / longer;
            return std::max(kSizeStep, (scaled + kSizeStep / 2) / kSizeStep * kSizeStep);
        };
        const glm::ivec2 size{shorter(wanted.x), shorter(wanted.y)};
        if (!take(id, size)) continue;
        if (size != wanted) ++shrunk_;
        sizes_[static_cast<std::size_t>(id)] = size;
        free_ids_.pop_back();
        return id;
    }
    return kNone;
}

void Atlas::release(Id id) noexcept {
    if (id == kNone) return;
    give_back(id);
    sizes_[static_cast<std::size_t>(id)] = glm::ivec2{0};
    free_ids_.push_back(id);
}

bool Atlas::tidy(double /*time_s*/) noexcept {
    return false;
}

}  // namespace skyig::render::cloud::impostor
