#include "render/cloud/impostor/atlas_tiles.h"

#include <algorithm>

namespace skyig::render::cloud::impostor {

TileAtlas::TileAtlas(const AtlasSettings& settings)
    : Atlas(settings),
      payload_(settings.tile_side - 2),
      columns_(settings.size.x / settings.tile_side),
      most_tiles_(0) {
    const glm::ivec2 most = tiles_of(glm::ivec2{settings.most_side});
    most_tiles_ = static_cast<std::size_t>(most.x) * static_cast<std::size_t>(most.y);
    tiles_.resize(most_tiles_ * sizes_.size());
    const int count = columns_ * (settings.size.y / settings.tile_side);
    for (int tile = count; tile-- > 0;)
        free_.push_back(static_cast<std::uint16_t>(tile));
}

glm::ivec2 TileAtlas::tiles_of(glm::ivec2 size) const noexcept {
    return (size + payload_ - 1) / payload_;
}

std::span<std::uint16_t> TileAtlas::tiles(Id id, glm::ivec2 count) noexcept {
    return {tiles_.data() + static_cast<std::size_t>(id) * most_tiles_,
            static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y)};
}

glm::ivec2 TileAtlas::place(std::uint16_t tile) const noexcept {
    return glm::ivec2{tile % columns_, tile / columns_} * settings_.tile_side;
}

bool TileAtlas::take(Id id, glm::ivec2 size) noexcept {
    const std::span<std::uint16_t> own = tiles(id, tiles_of(size));
    if (own.size() > free_.size()) return false;
    for (std::uint16_t& tile : own) {
        tile = free_.back();
        free_.pop_back();
    }
    return true;
}

void TileAtlas::give_back(Id id) noexcept {
    for (const std::uint16_t tile : tiles(id, tiles_of(size(id))))
        free_.push_back(tile);
}

void TileAtlas::write(Id id, const Texel* picture) noexcept {
    const glm::ivec2 count = size(id);
    const glm::ivec2 grid = tiles_of(count);
    const std::span<const std::uint16_t> own = tiles(id, grid);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const int column = static_cast<int>(i) % grid.x;
        const int row = static_cast<int>(i) / grid.x;
        const glm::ivec2 to = place(own[i]);
        for (int y = 0; y < settings_.tile_side; ++y) {
            const int from_y = std::clamp(row * payload_ + y - 1, 0, count.y - 1);
            const Texel* from = picture + static_cast<std::ptrdiff_t>(from_y) * count.x;
            for (int x = 0; x < settings_.tile_side; ++x)
                *texel(to.x + x, to.y + y) = from[std::clamp(column * payload_ + x - 1, 0, count.x - 1)];
        }
    }
}

const Texel* TileAtlas::corner(Id id, glm::ivec2 at, int& stride) const noexcept {
    const glm::ivec2 cell = at / payload_;
    const glm::ivec2 grid = tiles_of(size(id));
    const std::size_t index =
        static_cast<std::size_t>(id) * most_tiles_ + static_cast<std::size_t>(cell.y * grid.x + cell.x);
    const glm::ivec2 from = place(tiles_[index]) + at - cell * payload_ + 1;
    stride = settings_.size.x;
    return texel(from.x, from.y);
}

std::size_t TileAtlas::free_texels() const noexcept {
    return free_.size() * static_cast<std::size_t>(settings_.tile_side * settings_.tile_side);
}

void TileAtlas::places(Id id, std::vector<glm::ivec4>& out) const {
    const glm::ivec2 grid = tiles_of(size(id));
    for (std::size_t i = 0; i < static_cast<std::size_t>(grid.x * grid.y); ++i) {
        out.emplace_back(place(tiles_[static_cast<std::size_t>(id) * most_tiles_ + i]),
                         glm::ivec2{settings_.tile_side});
    }
}

}  // namespace skyig::render::cloud::impostor
