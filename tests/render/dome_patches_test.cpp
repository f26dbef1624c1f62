#include "render/dome_patches.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "render/dome.h"
#include "render/geometry.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using tests::kDegree;

glm::dmat4 clip_from_enu(const Frustum& frustum, const glm::dmat3& view_from_enu) {
    const ImagePlane p = image_plane(frustum);
    const double width = p.right - p.left;
    const double height = p.top - p.bottom;
    const glm::dmat4 clip_from_view{
        glm::dvec4{2.0 / width, 0.0, 0.0, 0.0}, glm::dvec4{0.0, 2.0 / height, 0.0, 0.0},
        glm::dvec4{(p.right + p.left) / width, (p.top + p.bottom) / height, 0.0, -1.0}, glm::dvec4{0.0}};
    return clip_from_view * glm::dmat4{view_from_enu};
}

// The triangle that a direction of view pierces, by its first index.
std::size_t pierced(const Dome& dome, const glm::dvec3& direction) {
    const auto vertices = dome.vertices();
    const auto indices = dome.indices();
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::dmat3 corners{glm::dvec3{vertices[indices[i]].direction},
                                 glm::dvec3{vertices[indices[i + 1]].direction},
                                 glm::dvec3{vertices[indices[i + 2]].direction}};
        if (std::abs(glm::determinant(corners)) < 1e-14) continue;
        const glm::dvec3 w = glm::inverse(corners) * direction;
        if (w.x >= 0.0 && w.y >= 0.0 && w.z >= 0.0) return i;
    }
    return indices.size();
}

TEST(DomePatches, EveryTriangleStandsInTheBufferOnce) {
    const DomePatches patches(19, 21);
    EXPECT_EQ(patches.indices().size(), 19U * 21U * 6U);
    std::set<std::array<std::uint32_t, 3>> seen;
    for (std::size_t i = 0; i < patches.indices().size(); i += 3)
        seen.insert({patches.indices()[i], patches.indices()[i + 1], patches.indices()[i + 2]});
    EXPECT_EQ(seen.size(), 19U * 21U * 2U);
}

TEST(DomePatches, WhateverTheViewPiercesIsDrawn) {
    std::mt19937 random{3};
    std::uniform_real_distribution<double> unit{0.0, 1.0};
    Dome dome;
    for (const double half_deg : {0.5, 30.0, 60.0, 85.0}) {
        for (const double pitch_deg : {-90.0, -20.0, 0.0, 35.0, 90.0}) {
            dome.lay_out({-2.0 * kDegree, 8e-4, 10.0 * kDegree, true, 0.0, 0.0, false});
            const Frustum frustum = tests::symmetric_frustum(half_deg, 100, 80);
            const glm::dmat3 view{tests::view_from_enu(360.0 * unit(random), pitch_deg, 20.0)};
            const auto ranges = dome.visible(clip_from_enu(frustum, view));
            const ImagePlane p = image_plane(frustum);
            for (int i = 0; i < 12; ++i) {
                // The corners and edges of the picture are where culling would show first.
                const double x = i < 4 ? static_cast<double>(i % 2) : unit(random);
                const double y = i < 4 ? static_cast<double>(i / 2) : i < 8 ? 1.0 : unit(random);
                const glm::dvec3 in_view{glm::mix(p.left, p.right, x), glm::mix(p.bottom, p.top, y), -1.0};
                const std::size_t index = pierced(dome, glm::normalize(glm::transpose(view) * in_view));
                ASSERT_LT(index, dome.indices().size());
                const bool drawn = std::any_of(ranges.begin(), ranges.end(), [&](const IndexRange& range) {
                    return index >= range.first && index < range.first + range.count;
                });
                EXPECT_TRUE(drawn) << half_deg << " " << pitch_deg << " " << x << " " << y;
            }
        }
    }
}

TEST(DomePatches, AViewOfSixtyDegreesLeavesMostOfTheDomeOut) {
    Dome dome;
    dome.lay_out({-0.5 * kDegree, 8e-4, 40.0 * kDegree, true, 0.0, 0.0, false});
    std::size_t drawn = 0;
    for (const IndexRange& range : dome.visible(clip_from_enu(
             tests::symmetric_frustum(30.0, 1280, 1024), glm::dmat3{tests::view_from_enu(120.0, 8.0, 0.0)})))
        drawn += range.count;
    const double share = static_cast<double>(drawn) / static_cast<double>(dome.indices().size());
    RecordProperty("share_of_triangles", std::to_string(share));
    EXPECT_LT(share, 0.35);
}

}  // namespace
}  // namespace skyig::render
