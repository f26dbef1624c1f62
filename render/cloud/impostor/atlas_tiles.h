// Pictures cut into the fixed tiles of an atlas, each with a texel of its neighbours all round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/cloud/impostor/atlas.h"

namespace skyig::render::cloud::impostor {

class TileAtlas final : public Atlas {
  public:
    explicit TileAtlas(const AtlasSettings& settings);

    void write(Id id, const Texel* picture) noexcept override;
    [[nodiscard]] const Texel* corner(Id id, glm::ivec2 at, int& stride) const noexcept override;
    [[nodiscard]] std::size_t free_texels() const noexcept override;
    void places(Id id, std::vector<glm::ivec4>& out) const override;

  private:
    [[nodiscard]] bool take(Id id, glm::ivec2 size) noexcept override;
    void give_back(Id id) noexcept override;
    /// That a picture of this many texels needs.
    [[nodiscard]] glm::ivec2 tiles_of(glm::ivec2 size) const noexcept;
    [[nodiscard]] std::span<std::uint16_t> tiles(Id id, glm::ivec2 count) noexcept;
    [[nodiscard]] glm::ivec2 place(std::uint16_t tile) const noexcept;

    /// Texels of a picture that a tile stands for, along a side.
    int payload_;
    int columns_;
    std::size_t most_tiles_;
    std::vector<std::uint16_t> free_;
    std::vector<std::uint16_t> tiles_;
};

}  // namespace skyig::render::cloud::impostor
