// Tables over directions: how rows crowd at the horizon, and smooth interpolation between nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace skyig::render::sky {

/// Two colours and two spare places.
using Node = std::array<float, 8>;

/// Rows over the angle from the horizon, w in 0..1: angle = scale (cosh(growth w) - 1), quadratic at the
/// start, where distances go with the root of the angle, and a geometric progression further away.
struct Progression {
    double range_rad = 1.0;
    double scale_rad = 1.0;
    double growth = 1.0;

    static Progression over(double range_rad, double scale_rad) {
        const double ratio = range_rad / scale_rad;
        return {range_rad, scale_rad, std::log1p(ratio + std::sqrt(ratio * (2.0 + ratio)))};
    }
    [[nodiscard]] double angle_rad(double w) const noexcept {
        const double half = std::sinh(0.5 * growth * w);
        return std::min(range_rad, 2.0 * scale_rad * half * half);
    }
    [[nodiscard]] float w(float angle_rad) const noexcept {
        const float y = angle_rad / static_cast<float>(scale_rad);
        return std::log(1.0F + (y + std::sqrt(y * (2.0F + y)))) / static_cast<float>(growth);
    }
};

[[nodiscard]] inline std::array<float, 4> catmull_rom(float t) {
    const float t2 = t * t;
    const float t3 = t2 * t;
    return {0.5F * (2.0F * t2 - t - t3), 0.5F * (2.0F - 5.0F * t2 + 3.0F * t3),
            0.5F * (t + 4.0F * t2 - 3.0F * t3), 0.5F * (t3 - t2)};
}

/// A grid with one node of margin on every side, so that the cubic needs no special cases.
class Grid {
  public:
    Grid(int rows, int columns)
        : rows_(rows),
          columns_(columns),
          nodes_(static_cast<std::size_t>(rows + 2) * static_cast<std::size_t>(columns + 2)) {}

    [[nodiscard]] Node& at(int row, int column) noexcept { return nodes_[index(row, column)]; }
    [[nodiscard]] int rows() const noexcept { return rows_; }

    // Mirror about the source's azimuth and its opposite.
    void close_row(int row) noexcept {
        at(row, -1) = at(row, 1);
        at(row, columns_) = at(row, columns_ - 2);
    }
    // `even`: the first row is a mirror, too (smooth in the square of the row); otherwise all margins
    // continue quadratically.
    void close(bool even) noexcept {
        for (int column = -1; column <= columns_; ++column) {
            if (even) {
                at(-1, column) = at(1, column);
            } else {
                extend(at(0, column), at(1, column), at(2, column), at(-1, column));
            }
            extend(at(rows_ - 1, column), at(rows_ - 2, column), at(rows_ - 3, column), at(rows_, column));
        }
    }
    /// By the cubic, and by straight lines between the four nodes around.
    struct Sample {
        Node cubic{};
        Node linear{};
    };
    [[nodiscard]] Sample sample(float row, float column) const noexcept {
        const int i = std::clamp(static_cast<int>(row), 0, rows_ - 2);
        const int j = std::clamp(static_cast<int>(column), 0, columns_ - 2);
        const float up = std::clamp(row - static_cast<float>(i), 0.0F, 1.0F);
        const float right = std::clamp(column - static_cast<float>(j), 0.0F, 1.0F);
        const auto by_row = catmull_rom(up);
        const auto by_column = catmull_rom(right);
        Sample sample;
        Node& sum = sample.cubic;
        for (int a = 0; a < 4; ++a) {
            const Node* line = &nodes_[index(i - 1 + a, j - 1)];
            for (std::size_t b = 0; b < 4; ++b) {
                const float weight = by_row[static_cast<std::size_t>(a)] * by_column[b];
                for (std::size_t k = 0; k < sum.size(); ++k)
                    sum[k] += weight * line[b][k];
            }
        }
        const Node* low = &nodes_[index(i, j)];
        const Node* high = &nodes_[index(i + 1, j)];
        for (std::size_t k = 0; k < sum.size(); ++k) {
            const float below = low[0][k] + right * (low[1][k] - low[0][k]);
            const float above = high[0][k] + right * (high[1][k] - high[0][k]);
            sample.linear[k] = below + up * (above - below);
        }
        return sample;
    }

  private:
    [[nodiscard]] std::size_t index(int row, int column) const noexcept {
        return static_cast<std::size_t>(row + 1) * static_cast<std::size_t>(columns_ + 2) +
               static_cast<std::size_t>(column + 1);
    }
    static void extend(const Node& edge, const Node& next, const Node& third, Node& margin) noexcept {
        for (std::size_t k = 0; k < margin.size(); ++k) {
            margin[k] = 3.0F * edge[k] - 3.0F * next[k] + third[k];
        }
    }

    int rows_;
    int columns_;
    std::vector<Node> nodes_;
};

}  // namespace skyig::render::sky
