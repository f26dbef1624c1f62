// The dome's triangles in patches, so that a channel draws those alone that stand in its view: most of what a
// dome costs beside its pixels is triangles that no channel sees. Free of GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace skyig::render {

/// A run of the index buffer.
struct IndexRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// Some rows of quads: both ends are multiples of DomePatches::kSide, or the last is the grid's own.
struct QuadRows {
    std::uint32_t first = 0;
    std::uint32_t end = std::numeric_limits<std::uint32_t>::max();
};

/// A grid of rows x columns of directions, cut into patches of at most kSide x kSide quads.
class DomePatches {
  public:
    static constexpr std::uint32_t kSide = 8;

    /// \param rows, columns  quads each way; row-major vertices, columns + 1 in a row
    DomePatches(std::uint32_t rows, std::uint32_t columns);

    /// Another grid, none larger than the first one. Allocates nothing.
    void resize(std::uint32_t rows, std::uint32_t columns);

    /// Along which diagonal each quad is cut in two. \param rising  quads, row by row: not 0 if the cut runs
    /// from the lower column in the lower row to the higher in the higher; all are 0 after resize()
    void split(std::span<const std::uint8_t> rising) noexcept;

    /// Triangles, patch by patch.
    [[nodiscard]] std::span<const std::uint32_t> indices() const noexcept { return indices_; }

    /// Takes over where the vertices lie. \param directions  unit vectors, (rows + 1) * (columns + 1)
    void bound(std::span<const glm::vec3> directions) noexcept;

    /// The runs of indices whose triangles may show. \param clip_from_dome  its first, second and fourth rows
    /// span the view: -w <= x, y <= w; applied to (direction, 1), its last column shifts all vertices by a
    /// little. \param rows  no others. Valid until the next call; allocates nothing.
    [[nodiscard]] std::span<const IndexRange> visible(const glm::dmat4& clip_from_dome,
                                                      const QuadRows& rows = {}) noexcept;

  private:
    struct Patch {
        std::uint32_t row = 0;
        std::uint32_t column = 0;
        std::uint32_t rows = 0;
        std::uint32_t columns = 0;
        IndexRange range;
        /// The cone that holds the patch: its axis, and the sine of its half angle (1: a half space or more).
        glm::dvec3 axis{0.0, 0.0, 1.0};
        double sine = 1.0;
    };
    template <class Rising>
    void cut(Rising rising) noexcept {
        auto out = indices_.begin();
        const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            *out++ = a;
            *out++ = b;
            *out++ = c;
        };
        for (const Patch& patch : patches_) {
            for (std::uint32_t r = patch.row; r < patch.row + patch.rows; ++r) {
                for (std::uint32_t c = patch.column; c < patch.column + patch.columns; ++c) {
                    const std::uint32_t low = r * stride_ + c;
                    const std::uint32_t high = low + stride_;
                    const bool cut_rises = rising(std::size_t{r} * (stride_ - 1) + c);
                    put(low, low + 1, cut_rises ? high + 1 : high);
                    put(high, cut_rises ? low : low + 1, high + 1);
                }
            }
        }
    }

    std::uint32_t stride_ = 1;
    std::vector<std::uint32_t> indices_;
    std::vector<Patch> patches_;
    std::vector<IndexRange> visible_;
};

}  // namespace skyig::render
