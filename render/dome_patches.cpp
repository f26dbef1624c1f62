#include "render/dome_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skyig::render {

DomePatches::DomePatches(std::uint32_t rows, std::uint32_t columns) {
    const auto patches = [](std::uint32_t quads) { return std::size_t{(quads + kSide - 1) / kSide}; };
    indices_.reserve(std::size_t{rows} * columns * 6);
    patches_.reserve(patches(rows) * patches(columns));
    visible_.reserve(patches(rows) * patches(columns));
    resize(rows, columns);
}

void DomePatches::resize(std::uint32_t rows, std::uint32_t columns) {
    stride_ = columns + 1;
    indices_.clear();
    patches_.clear();
    patches_across_ = (columns + kSide - 1) / kSide;
    for (std::uint32_t row = 0; row < rows; row += kSide) {
        for (std::uint32_t column = 0; column < columns; column += kSide)
            patches_.push_back(
                {row, column, std::min(kSide, rows - row), std::min(kSide, columns - column), 1, {}});
    }
    cut([](const Quad&) { return false; });
}

std::uint32_t DomePatches::shared_step(std::size_t patch, int side) const noexcept {
    const std::uint32_t own = patches_[patch].step;
    if (side < 0)
        return patch < patches_across_ ? own : std::min(own, patches_[patch - patches_across_].step);
    const std::size_t above = patch + patches_across_;
    return above < patches_.size() ? std::min(own, patches_[above].step) : own;
}

void DomePatches::put(std::uint32_t a, std::uint32_t b, std::uint32_t c) noexcept {
    indices_.push_back(a);
    indices_.push_back(b);
    indices_.push_back(c);
}

void DomePatches::put_quad(const Quad& quad, bool rising) noexcept {
    const std::uint32_t low = quad.row * stride_ + quad.column;
    const std::uint32_t high = low + stride_;
    put(low, low + quad.step, rising ? high + quad.step : high);
    put(high, rising ? low : low + quad.step, high + quad.step);
}

// A zip along both rows from the lower column on: the row that lags steps first.
void DomePatches::put_stitches(const Quad& quad, std::uint32_t low_step, std::uint32_t high_step) noexcept {
    const std::uint32_t low = quad.row * stride_ + quad.column;
    const std::uint32_t high = low + stride_;
    std::uint32_t at_low = 0;
    std::uint32_t at_high = 0;
    while (at_low < quad.step || at_high < quad.step) {
        if (at_high >= quad.step || (at_low < quad.step && at_low + low_step <= at_high + high_step)) {
            put(low + at_low, low + at_low + low_step, high + at_high);
            at_low += low_step;
        } else {
            put(high + at_high, low + at_low, high + at_high + high_step);
            at_high += high_step;
        }
    }
}

void DomePatches::bound(std::span<const glm::vec3> directions) noexcept {
    for (Patch& patch : patches_) {
        glm::dvec3 sum{0.0};
        const auto each = [&](auto&& use) {
            for (std::uint32_t r = patch.row; r <= patch.row + patch.rows; ++r) {
                for (std::uint32_t c = patch.column; c <= patch.column + patch.columns; ++c)
                    use(glm::dvec3{directions[std::size_t{r} * stride_ + c]});
            }
        };
        each([&](const glm::dvec3& d) { sum += d; });
        const double length = glm::length(sum);
        patch.axis = length > 0.0 ? sum / length : glm::dvec3{0.0, 0.0, 1.0};
        double cosine = 1.0;
        each([&](const glm::dvec3& d) { cosine = std::min(cosine, glm::dot(patch.axis, d)); });
        // A flat triangle stays inside the cone of its corners as long as that is narrower than a half space.
        constexpr double kRounding = 1e-6;
        patch.sine = cosine > 0.0 ? std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) + kRounding : 1.0;
    }
}

std::span<const IndexRange> DomePatches::visible(const glm::dmat4& clip_from_dome,
                                                 std::span<const glm::dvec4> inside, const QuadRows& rows,
                                                 Marked which) noexcept {
    const auto row = [&](int i) {
        return glm::dvec4{clip_from_dome[0][i], clip_from_dome[1][i], clip_from_dome[2][i],
                          clip_from_dome[3][i]};
    };
    const glm::dvec4 x = row(0);
    const glm::dvec4 y = row(1);
    const glm::dvec4 w = row(3);
    // Each points into the view; its last component is what the shift of all vertices adds.
    std::array<glm::dvec4, 4> sides{w + x, w - x, w + y, w - y};
    for (glm::dvec4& side : sides)
        side /= glm::length(glm::dvec3{side});
    visible_.clear();
    for (const Patch& patch : patches_) {
        if (patch.row < rows.first || patch.row >= rows.end) continue;
        if (which != Marked::kAll && patch.marked != (which == Marked::kYes)) continue;
        const auto misses = [&](const glm::dvec4& side) {
            return glm::dot(glm::dvec3{side}, patch.axis) + std::max(side.w, 0.0) < -patch.sine;
        };
        if (std::any_of(sides.begin(), sides.end(), misses)) continue;
        if (std::any_of(inside.begin(), inside.end(), misses)) continue;
        if (!visible_.empty() && visible_.back().first + visible_.back().count == patch.range.first)
            visible_.back().count += patch.range.count;
        else
            visible_.push_back(patch.range);
    }
    return visible_;
}

}  // namespace skyig::render
