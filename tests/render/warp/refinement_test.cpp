// What the refinement of a mesh must keep: surface, order, and edges without gaps.
#include "render/refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr std::size_t kFloats = 4;  // a direction and a value

// A quarter of the sky in cells of 15 deg.
struct Patch {
    std::vector<float> vertices;
    std::vector<std::uint32_t> indices;

    Patch() {
        for (std::uint32_t row = 0; row <= 4; ++row) {
            for (std::uint32_t column = 0; column <= 6; ++column) {
                const glm::dvec3 d = at(15.0 * row, 15.0 * column);
                for (const double value : {d.x, d.y, d.z, 1.0 + column})
                    vertices.push_back(static_cast<float>(value));
                if (row == 4 || column == 6) continue;
                const std::uint32_t low = row * 7 + column;
                for (const std::uint32_t i : {0U, 1U, 7U, 7U, 1U, 8U})
                    indices.push_back(low + i);
            }
        }
    }
};

struct Refined {
    std::vector<float> vertices;
    glm::dvec3 direction(std::uint32_t i) const {
        return {vertices[i * kFloats], vertices[i * kFloats + 1], vertices[i * kFloats + 2]};
    }
};

Refined all_vertices(const Patch& patch, Refinement& refinement) {
    Refined all{patch.vertices};
    const auto added = refinement.added(patch.vertices, kFloats);
    all.vertices.insert(all.vertices.end(), added.begin(), added.end());
    return all;
}

TEST(Refinement, NoEdgeIsLongerThanAskedAndEveryInnerOneHasTwoTriangles) {
    const Patch patch;
    Refinement refinement;
    refinement.refine(patch.indices, patch.vertices, kFloats, 4.0 * kDegree);
    const Refined all = all_vertices(patch, refinement);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double longest = 0.0;
    const auto indices = refinement.indices();
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(indices[i + k], indices[i + (k + 1) % 3]);
            ++edges[{a, b}];
            longest = std::max(longest, glm::length(all.direction(a) - all.direction(b)));
        }
    }
    EXPECT_LE(longest, 2.0 * std::sin(2.0 * kDegree) + 1e-6);
    // An edge of one triangle lies on the outline; a gap would show as one inside.
    for (const auto& [edge, count] : edges) {
        const glm::dvec3 middle = 0.5 * (all.direction(edge.first) + all.direction(edge.second));
        const bool outline = middle.z < 1e-6 || std::abs(middle.x) < 1e-6 || std::abs(middle.y) < 1e-6 ||
                             (all.direction(edge.first).z > 0.86 && all.direction(edge.second).z > 0.86);
        if (!outline) {
            ASSERT_EQ(count, 2) << edge.first << " " << edge.second;
        }
    }
    std::printf("%zu triangles of %zu\n", indices.size() / 3, patch.indices.size() / 3);
}

TEST(Refinement, KeepsTheSurfaceAndItsValues) {
    const Patch patch;
    Refinement refinement;
    refinement.refine(patch.indices, patch.vertices, kFloats, 4.0 * kDegree);
    const Refined all = all_vertices(patch, refinement);
    for (std::size_t triangle = 0; triangle < patch.indices.size() / 3; ++triangle) {
        const std::uint32_t* corners = &patch.indices[3 * triangle];
        const glm::dvec3 a = all.direction(corners[0]);
        const glm::dvec3 normal =
            glm::normalize(glm::cross(all.direction(corners[1]) - a, all.direction(corners[2]) - a));
        double area = 0.0;
        const IndexRange range = refinement.range({3 * triangle, 3});
        ASSERT_GT(range.count, 0U);
        for (std::size_t i = range.first; i < range.first + range.count; i += 3) {
            const glm::dvec3 p = all.direction(refinement.indices()[i]);
            const glm::dvec3 q = all.direction(refinement.indices()[i + 1]);
            const glm::dvec3 r = all.direction(refinement.indices()[i + 2]);
            ASSERT_NEAR(glm::dot(p - a, normal), 0.0, 1e-6);
            area += glm::dot(glm::cross(q - p, r - p), normal);
        }
        EXPECT_NEAR(
            area, glm::dot(glm::cross(all.direction(corners[1]) - a, all.direction(corners[2]) - a), normal),
            1e-6);
    }
}

TEST(Refinement, LeavesShortEdgesAndTrianglesWithoutVerticesOut) {
    const Patch patch;
    Refinement refinement;
    refinement.refine(patch.indices, patch.vertices, kFloats, 60.0 * kDegree);
    EXPECT_TRUE(std::equal(refinement.indices().begin(), refinement.indices().end(), patch.indices.begin(),
                           patch.indices.end()));
    EXPECT_TRUE(refinement.added(patch.vertices, kFloats).empty());
    // The lowest row of cells alone.
    refinement.refine(patch.indices, std::span{patch.vertices}.first(14 * kFloats), kFloats, 60.0 * kDegree);
    EXPECT_EQ(refinement.indices().size(), 6U * 6U);
    EXPECT_EQ(refinement.range({36, 36}).count, 0U);
}

}  // namespace
}  // namespace skyig::render
