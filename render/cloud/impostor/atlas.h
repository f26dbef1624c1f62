// Where pictures of clouds are kept: one block of texels, shared out by one of three schemes (seed 003).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "render/cloud/impostor/kernels.h"

namespace skyig::render::cloud::impostor {

enum class AtlasScheme : std::uint8_t {
    kBestFit,       ///< rectangles, each where it leaves least room beside it; they stay where they are
    kDefragmented,  ///< the same, packed anew when something did not fit, a few times a second at most
    kTiles,  ///< fixed tiles with a border of a texel: nothing to fragment, (n / (n - 2))^2 of the room
};

struct AtlasSettings {
    AtlasScheme scheme = AtlasScheme::kBestFit;
    /// Texels, multiples of 32.
    glm::ivec2 size{2048, 1024};
    /// Pictures of at most this many texels a side, a multiple of 16.
    int most_side = 256;
    /// That it holds at once, at most.
    int pictures = 2048;
    /// Of scene time: how often it may be packed anew.
    double defragmentations_per_s = 2.0;
    /// kTiles: 16 or 32.
    int tile_side = 32;
};

/// All sizes are in texels and multiples of 16. Allocates at construction alone.
class Atlas {
  public:
    using Id = int;
    static constexpr Id kNone = -1;

    [[nodiscard]] static std::unique_ptr<Atlas> make(const AtlasSettings& settings);
    virtual ~Atlas() = default;
    Atlas(const Atlas&) = delete;
    Atlas& operator=(const Atlas&) = delete;
    Atlas(Atlas&&) = delete;
    Atlas& operator=(Atlas&&) = delete;

    /// Room for a picture, or, where there is none, for the largest one of nearly the same aspect; kNone: the
    /// atlas is full. What it holds is not defined until written.
    [[nodiscard]] Id allocate(glm::ivec2 wanted) noexcept;
    void release(Id id) noexcept;
    [[nodiscard]] glm::ivec2 size(Id id) const noexcept { return sizes_[static_cast<std::size_t>(id)]; }

    /// \param picture  size(id) texels, row by row
    virtual void write(Id id, const Texel* picture) noexcept = 0;
    /// Four neighbouring texels from one corner on. \param at  0..size - 2 \param stride  from row to row
    [[nodiscard]] virtual const Texel* corner(Id id, glm::ivec2 at, int& stride) const noexcept = 0;
    /// Packs anew if that is this scheme's way, is of use and is allowed at this scene time. Pictures keep
    /// their ids. \return whether it did
    virtual bool tidy(double time_s) noexcept;

    /// Of the atlas, whether or not a picture of a size still fits into them.
    [[nodiscard]] virtual std::size_t free_texels() const noexcept = 0;
    /// The rectangles that a picture takes up, for who checks that none meets another: x, y, width, height.
    virtual void places(Id id, std::vector<glm::ivec4>& out) const = 0;
    /// Pictures that had to be smaller than wanted, since construction.
    [[nodiscard]] std::size_t shrunk() const noexcept { return shrunk_; }

  protected:
    explicit Atlas(const AtlasSettings& settings);
    /// Finds and takes the place, whole or not at all.
    [[nodiscard]] virtual bool take(Id id, glm::ivec2 size) noexcept = 0;
    virtual void give_back(Id id) noexcept = 0;

    [[nodiscard]] Texel* texel(int x, int y) noexcept {
        return texels_.data() + static_cast<std::ptrdiff_t>(y) * settings_.size.x + x;
    }
    [[nodiscard]] const Texel* texel(int x, int y) const noexcept {
        return texels_.data() + static_cast<std::ptrdiff_t>(y) * settings_.size.x + x;
    }

    AtlasSettings settings_;
    std::vector<Texel> texels_;
    std::vector<glm::ivec2> sizes_;

  private:
    std::vector<Id> free_ids_;
    std::size_t shrunk_ = 0;
};

}  // namespace skyig::render::cloud::impostor
