// The dome's triangles in patches, so that a channel draws those alone that stand in its view: most of what a
// dome costs beside its pixels is triangles that no channel sees. Free of GL.
#pragma once

#include <array>
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

/// Which patches: see DomePatches::mark().
enum class Marked { kAll, kYes, kNo };

/// A grid of rows x columns of directions, cut into patches of at most kSide x kSide quads.
class DomePatches {
  public:
    static constexpr std::uint32_t kSide = 4;

    /// \param rows, columns  quads each way; row-major vertices, columns + 1 in a row
    DomePatches(std::uint32_t rows, std::uint32_t columns);

    /// Another grid, none larger than the first one. Allocates nothing.
    void resize(std::uint32_t rows, std::uint32_t columns);

    /// Quads of a row that are drawn as one.
    static constexpr std::array<std::uint32_t, 3> kSteps{4, 2, 1};
    /// A run of columns between two rows that is cut into triangles.
    struct Quad {
        std::uint32_t row = 0;
        std::uint32_t column = 0;
        std::uint32_t step = 1;
    };

    /// Makes the triangles anew. Each patch leaves out as many of its columns as it may; where two patches of
    /// different steps meet, both keep the columns of the finer one, so that no gap opens.
    /// \param may_thin  (Quad of the patch's corner, rows, columns) -> bool: whether the patch may be drawn
    /// by every step-th of its columns alone \param rising  (Quad) -> bool: whether it is cut from the lower
    /// column in the lower row to the higher in the higher; false for all after resize()
    template <class MayThin, class Rising>
    void triangulate(MayThin may_thin, Rising rising) noexcept {
        for (Patch& patch : patches_) {
            patch.step = 1;
            for (const std::uint32_t step : kSteps) {
                if (patch.columns % step != 0) continue;
                if (step > 1 && !may_thin(Quad{patch.row, patch.column, step}, patch.rows, patch.columns))
                    continue;
                patch.step = step;
                break;
            }
        }
        cut(rising);
    }

    /// Triangles, patch by patch.
    [[nodiscard]] std::span<const std::uint32_t> indices() const noexcept { return indices_; }

    /// Takes over where the vertices lie. \param directions  unit vectors, (rows + 1) * (columns + 1)
    void bound(std::span<const glm::vec3> directions) noexcept;

    /// The runs of indices whose triangles may show. \param clip_from_dome  its first, second and fourth rows
    /// span the view: -w <= x, y <= w; applied to (direction, 1), its last column shifts all vertices by a
    /// little. \param rows  no others. Valid until the next call; allocates nothing.
    [[nodiscard]] std::span<const IndexRange> visible(const glm::dmat4& clip_from_dome,
                                                      const QuadRows& rows = {},
                                                      Marked which = Marked::kAll) noexcept {
        return visible(clip_from_dome, {}, rows, which);
    }
    /// Of those, what may show within more half spaces. \param inside  each: (normal, what the shift adds),
    /// positive inside
    [[nodiscard]] std::span<const IndexRange> visible(const glm::dmat4& clip_from_dome,
                                                      std::span<const glm::dvec4> inside,
                                                      const QuadRows& rows, Marked which) noexcept;

    /// Marks patches anew. \param meets  (axis of the cone that holds a patch, sine of its half angle) ->
    /// bool
    template <class Meets>
    void mark(Meets meets) noexcept {
        for (Patch& patch : patches_)
            patch.marked = meets(patch.axis, patch.sine);
    }

  private:
    struct Patch {
        std::uint32_t row = 0;
        std::uint32_t column = 0;
        std::uint32_t rows = 0;
        std::uint32_t columns = 0;
        std::uint32_t step = 1;
        IndexRange range;
        /// The cone that holds the patch: its axis, and the sine of its half angle (1: a half space or more).
        glm::dvec3 axis{0.0, 0.0, 1.0};
        double sine = 1.0;
        bool marked = false;
    };
    template <class Rising>
    void cut(Rising rising) noexcept {
        indices_.clear();
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            Patch& patch = patches_[i];
            patch.range.first = indices_.size();
            for (std::uint32_t r = 0; r < patch.rows; ++r) {
                const std::uint32_t low = r == 0 ? shared_step(i, -1) : patch.step;
                const std::uint32_t high = r + 1 == patch.rows ? shared_step(i, 1) : patch.step;
                for (std::uint32_t c = 0; c < patch.columns; c += patch.step) {
                    const Quad quad{patch.row + r, patch.column + c, patch.step};
                    if (low == patch.step && high == patch.step)
                        put_quad(quad, rising(quad));
                    else
                        put_stitches(quad, low, high);
                }
            }
            patch.range.count = indices_.size() - patch.range.first;
        }
    }
    /// Of the row that a patch shares with the one above (1) or below (-1) it.
    [[nodiscard]] std::uint32_t shared_step(std::size_t patch, int side) const noexcept;
    void put(std::uint32_t a, std::uint32_t b, std::uint32_t c) noexcept;
    void put_quad(const Quad& quad, bool rising) noexcept;
    void put_stitches(const Quad& quad, std::uint32_t low_step, std::uint32_t high_step) noexcept;

    std::uint32_t stride_ = 1;
    std::size_t patches_across_ = 1;
    std::vector<std::uint32_t> indices_;
    std::vector<Patch> patches_;
    std::vector<IndexRange> visible_;
};

}  // namespace skyig::render
