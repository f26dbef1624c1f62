// How directions are spread over the cloud map: two squares of texels whose outermost ones lie on the rim,
// where both hold the same directions. Cut into tiles.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "render/channel.h"
#include "render/shaders/shared.h"

namespace skyig::render::cloud {

/// Of a square's side and of a tile's, texels.
inline constexpr int kTile = 32;
inline constexpr int kTileTexels = kTile * kTile;
inline constexpr int kLeastMap = 512;
inline constexpr int kLargestMap = 2048;

/// A cone of directions: unit axis, half angle.
struct Cone {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double cosine = 1.0;
    double sine = 0.0;
};

/// Of a tile and what is interpolated around it, unit vectors.
using Corners = std::array<glm::dvec3, 4>;

class MapGeometry {
  public:
    /// \param size  texels on a square's side, a multiple of kTile
    explicit MapGeometry(int size = kLeastMap) noexcept : size_(size) {}

    [[nodiscard]] int size() const noexcept { return size_; }
    [[nodiscard]] int tiles_across() const noexcept { return size_ / kTile; }
    [[nodiscard]] int tile_count() const noexcept { return 2 * tiles_across() * tiles_across(); }
    [[nodiscard]] std::size_t texel_count() const noexcept {
        return std::size_t{2} * static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
    }

    /// Texels stand in rows, those of the upper square first.
    struct Texel {
        int column = 0;
        int row = 0;  ///< of its square
        bool lower = false;
    };
    /// The first texel of a tile.
    [[nodiscard]] Texel corner(int tile) const noexcept;
    [[nodiscard]] std::size_t index(const Texel& texel) const noexcept {
        return static_cast<std::size_t>((texel.lower ? size_ : 0) + texel.row) *
                   static_cast<std::size_t>(size_) +
               static_cast<std::size_t>(texel.column);
    }
    /// The sizes of its components sum to 1. Places between and beside the texels are as good.
    [[nodiscard]] glm::vec3 direction(double column, double row, bool lower) const noexcept;
    /// Holds all directions between a tile's texels and their neighbours.
    [[nodiscard]] Cone cone(int tile) const noexcept { return cone(corner(tile), kTile); }
    /// The same of a square of texels.
    [[nodiscard]] Cone cone(const Texel& first, int side) const noexcept;
    [[nodiscard]] Corners corners(int tile) const noexcept;
    /// Angle between neighbouring texels at the middle of a face of the octahedron, where they stand widest.
    [[nodiscard]] double worst_texel_rad() const noexcept { return 3.22 / size_; }

    friend bool operator==(const MapGeometry&, const MapGeometry&) = default;

  private:
    int size_;
};

/// The smallest of 512, 1024 and 2048 whose texels are nowhere wider than four of the rig's finest pixels
/// (of 512, two and a half),
/// halved until what the views see of it is at most kMostSeenTexels.
[[nodiscard]] int map_size_for(double pixel_rad, std::span<const ChannelView> views) noexcept;
inline constexpr double kMostSeenTexels = 650e3;

/// Whether a view sees some of a cone. \param margin_rad  added to the cone
[[nodiscard]] bool sees(const ChannelView& view, const Cone& cone, double margin_rad) noexcept;
[[nodiscard]] bool sees(std::span<const ChannelView> views, const Cone& cone, double margin_rad) noexcept;
/// Whether a view may see some of what lies between corners: closer than by their cone.
[[nodiscard]] bool sees(std::span<const ChannelView> views, const Corners& corners) noexcept;

}  // namespace skyig::render::cloud
