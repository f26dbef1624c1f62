// Pictures as rectangles of an atlas, on a grid of 16 texels.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cloud/impostor/atlas.h"

namespace skyig::render::cloud::impostor {

class RectangleAtlas final : public Atlas {
  public:
    explicit RectangleAtlas(const AtlasSettings& settings);

    void write(Id id, const Texel* picture) noexcept override;
    [[nodiscard]] const Texel* corner(Id id, glm::ivec2 at, int& stride) const noexcept override;
    bool tidy(double time_s) noexcept override;
    [[nodiscard]] std::size_t free_texels() const noexcept override;
    void places(Id id, std::vector<glm::ivec4>& out) const override;

  private:
    [[nodiscard]] bool take(Id id, glm::ivec2 size) noexcept override;
    void give_back(Id id) noexcept override;
    /// Where `size` blocks leave least room beside them; -1: nowhere.
    [[nodiscard]] glm::ivec2 best_place(glm::ivec2 size) noexcept;
    void mark(glm::ivec2 place, glm::ivec2 size, bool taken) noexcept;
    [[nodiscard]] bool repack() noexcept;

    /// In blocks of 16 texels.
    glm::ivec2 blocks_;
    std::vector<std::uint8_t> taken_;
    std::size_t free_blocks_ = 0;
    /// Of a search: free blocks from each on, to the right and downwards.
    std::vector<std::int16_t> right_;
    std::vector<std::int16_t> down_;
    /// By Id, in blocks; x < 0: not in use.
    std::vector<glm::ivec2> places_;
    /// Of packing anew.
    std::vector<glm::ivec2> new_places_;
    std::vector<Id> order_;
    std::vector<Texel> scratch_;
    bool cramped_ = false;
    double next_s_ = 0.0;
    bool timed_ = false;
};

}  // namespace skyig::render::cloud::impostor
