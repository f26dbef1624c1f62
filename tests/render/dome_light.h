// What the dome of a frame shows in one direction, in double: the flat triangle that the direction pierces,
// its corners' colours interpolated as a rasteriser does it, without one.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

#include "render/sky_frame.h"

namespace skyig::render::tests {

class DomeLight {
  public:
    /// The frame must stay as it is.
    explicit DomeLight(const SkyFrame& frame)
        : dome_(frame.dome()), stride_(static_cast<std::size_t>(dome_.size().columns) + 1) {
        const glm::dmat4 enu_from_mesh = frame.enu_from_mesh();
        corners_.reserve(dome_.vertices().size());
        for (const DomeVertex& vertex : dome_.vertices())
            corners_.emplace_back(enu_from_mesh * glm::dvec4{glm::dvec3{vertex.direction}, 1.0});
        triangles_.resize(stride_ - 1);
        const auto indices = dome_.indices();
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const auto column = [&](std::size_t k) { return indices[i + k] % stride_; };
            const auto [first, last] = std::minmax({column(0), column(1), column(2)});
            for (std::size_t each = first; each < last; ++each)
                triangles_[each].push_back(i);
        }
    }

    /// The first index of the triangle.
    [[nodiscard]] std::optional<std::size_t> pierced(const glm::dvec3& direction_enu) const {
        for (std::size_t column = 0; column + 1 < stride_; ++column) {
            // Columns are meridians: planes through the zenith.
            const std::size_t middle = stride_ * (corners_.size() / stride_ / 2) + column;
            const glm::dvec3 up{0.0, 0.0, 1.0};
            if (glm::dot(glm::cross(up, corners_[middle]), direction_enu) > kRounding ||
                glm::dot(glm::cross(up, corners_[middle + 1]), direction_enu) < -kRounding ||
                glm::dot(glm::dvec2{corners_[middle]}, glm::dvec2{direction_enu}) < -kRounding)
                continue;
            if (const auto found = pierced_in(column, direction_enu)) return found;
        }
        return std::nullopt;
    }

    /// Encoded, 0..1, before dither.
    [[nodiscard]] std::optional<glm::dvec3> colour(const glm::dvec3& direction_enu) const {
        const auto first = pierced(direction_enu);
        if (!first) return std::nullopt;
        const glm::dvec3 w = weights(*first, direction_enu);
        glm::dvec3 sum{0.0};
        for (int i = 0; i < 3; ++i) {
            const DomeVertex& vertex =
                dome_.vertices()[dome_.indices()[*first + static_cast<std::size_t>(i)]];
            sum += w[i] * glm::mix(glm::dvec3{vertex.from}, glm::dvec3{vertex.to}, dome_.share());
        }
        return sum / (w.x + w.y + w.z);
    }

  private:
    static constexpr double kRounding = 1e-9;

    [[nodiscard]] glm::dvec3 weights(std::size_t first, const glm::dvec3& direction) const {
        const auto indices = dome_.indices();
        const glm::dmat3 triangle{corners_[indices[first]], corners_[indices[first + 1]],
                                  corners_[indices[first + 2]]};
        if (std::abs(glm::determinant(triangle)) < 1e-16) return glm::dvec3{-1.0};
        return glm::inverse(triangle) * direction;
    }

    [[nodiscard]] std::optional<std::size_t> pierced_in(std::size_t column,
                                                        const glm::dvec3& direction) const {
        for (const std::size_t triangle : triangles_[column]) {
            const glm::dvec3 w = weights(triangle, direction);
            if (std::min({w.x, w.y, w.z}) >= -1e-6 * std::max({w.x, w.y, w.z})) return triangle;
        }
        return std::nullopt;
    }

    const Dome& dome_;
    std::size_t stride_;
    std::vector<glm::dvec3> corners_;
    std::vector<std::vector<std::size_t>> triangles_;  // of each column between two meridians
};

struct CodeErrors {
    double median = 0.0;
    double p99 = 0.0;
    double largest = 0.0;
};

/// What the dome shows against the exact colours, display codes, in directions that crowd at the horizon and
/// at the source's azimuth, where the light bends. \param ground_share  of the directions that look down
inline CodeErrors interpolation_errors(const SkyFrame& frame, int count, double ground_share) {
    constexpr double kEdge_rad = 1.2e-3;  // beside the softened horizon of a pixel of 8e-4
    const DomeLight dome(frame);
    const double horizon = frame.light().horizon_elevation_rad;
    std::mt19937 random{11};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<double> errors;
    for (int i = 0; i < count; ++i) {
        const bool down = unit(random) < ground_share;
        const double range = down ? 1.55 + horizon : 1.5;
        const double above = (down ? -1.0 : 1.0) * (std::pow(unit(random), 2.0) * range + kEdge_rad);
        const double azimuth = (unit(random) < 0.5 ? -1 : 1) * std::pow(unit(random), 2.0) * 3.1 +
                               frame.dome().layout().azimuth_rad;
        const glm::dvec3 direction = direction_of({horizon + above, azimuth});
        const auto drawn = dome.colour(direction);
        EXPECT_TRUE(drawn);
        if (!drawn) continue;
        const glm::dvec3 d = glm::abs(*drawn - frame.exact_colour(direction)) * 255.0;
        errors.push_back(std::max({d.x, d.y, d.z}));
    }
    std::sort(errors.begin(), errors.end());
    return {errors[errors.size() / 2], errors[errors.size() * 99 / 100], errors.back()};
}

}  // namespace skyig::render::tests
