#include "render/dome_patches.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "tests/render/dome_light.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

glm::dmat4 clip_from_enu(const Frustum& frustum, const glm::dmat3& view_from_enu) {
    const ImagePlane p = image_plane(frustum);
    const double width = p.right - p.left;
    const double height = p.top - p.bottom;
    const glm::dmat4 clip_from_view{
        glm::dvec4{2.0 / width, 0.0, 0.0, 0.0}, glm::dvec4{0.0, 2.0 / height, 0.0, 0.0},
        glm::dvec4{(p.right + p.left) / width, (p.top + p.bottom) / height, 0.0, -1.0}, glm::dvec4{0.0}};
    return clip_from_view * glm::dmat4{view_from_enu};
}

TEST(DomePatches, EveryTriangleStandsInTheBufferOnce) {
    const DomePatches patches(19, 21);
    EXPECT_EQ(patches.indices().size(), 19U * 21U * 6U);
    std::set<std::array<std::uint32_t, 3>> seen;
    for (std::size_t i = 0; i < patches.indices().size(); i += 3)
        seen.insert({patches.indices()[i], patches.indices()[i + 1], patches.indices()[i + 2]});
    EXPECT_EQ(seen.size(), 19U * 21U * 2U);
}

TEST(DomePatches, AQuadIsCutAlongTheDiagonalThatIsAskedFor) {
    DomePatches patches(2, 3);  // corners of the second row's second quad: 5, 6 below and 9, 10 above
    patches.triangulate([](auto&&...) { return false; },
                        [](const DomePatches::Quad& quad) { return quad.row == 1 && quad.column == 1; });
    std::set<std::set<std::uint32_t>> triangles;
    for (std::size_t i = 0; i < patches.indices().size(); i += 3)
        triangles.insert({patches.indices()[i], patches.indices()[i + 1], patches.indices()[i + 2]});
    EXPECT_EQ(triangles.size(), 12U);
    EXPECT_TRUE(triangles.count({5, 6, 10}) == 1 && triangles.count({5, 9, 10}) == 1);
    EXPECT_TRUE(triangles.count({0, 1, 4}) == 1 && triangles.count({1, 4, 5}) == 1);
}

TEST(DomePatches, PatchesOfDifferentStepsMeetWithoutAGap) {
    constexpr std::uint32_t kRows = 19;
    constexpr std::uint32_t kColumns = 32;
    std::mt19937 random{5};
    for (int round = 0; round < 20; ++round) {
        DomePatches patches(kRows, kColumns);
        patches.triangulate([&](auto&&...) { return random() % 2 == 0; },
                            [&](auto&&) { return random() % 2 == 0; });
        EXPECT_LT(patches.indices().size(), kRows * kColumns * 6);
        // Inside every edge is run through once each way; the border's outermost edges once.
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
        double area = 0.0;
        const auto at = [&](std::size_t i) {
            const std::uint32_t index = patches.indices()[i];
            return glm::dvec2{index % (kColumns + 1), index / (kColumns + 1)};
        };
        for (std::size_t i = 0; i < patches.indices().size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::pair edge{patches.indices()[i + k], patches.indices()[i + (k + 1) % 3]};
                ++balance[edge];
                --balance[{edge.second, edge.first}];
            }
            const glm::dvec2 u = at(i + 1) - at(i);
            const glm::dvec2 v = at(i + 2) - at(i);
            const double twice = std::abs(u.x * v.y - u.y * v.x);
            EXPECT_GT(twice, 0.0);
            area += 0.5 * twice;
        }
        EXPECT_EQ(area, kRows * kColumns);
        const auto inside = [&](std::uint32_t index) {
            const std::uint32_t row = index / (kColumns + 1);
            const std::uint32_t column = index % (kColumns + 1);
            return row > 0 && row < kRows && column > 0 && column < kColumns;
        };
        for (const auto& [edge, count] : balance) {
            if (inside(edge.first) || inside(edge.second)) {
                EXPECT_EQ(count, 0) << edge.first << " " << edge.second;
            }
        }
    }
}

TEST(DomePatches, WhateverTheViewPiercesIsDrawn) {
    std::mt19937 random{3};
    std::uniform_real_distribution<double> unit{0.0, 1.0};
    SkyFrame frame({}, {});
    for (const double height_m : {1000.0, 1100.0}) {  // the second only shifts what the first has laid out
        frame.prepare(tests::make_scene(10.0, 120.0, -30.0, 300.0, height_m), 8e-4);
        const tests::DomeLight light(frame);
        for (const double half_deg : {0.5, 30.0, 60.0, 85.0}) {
            for (const double pitch_deg : {-90.0, -20.0, 0.0, 35.0, 90.0}) {
                const Frustum frustum = tests::symmetric_frustum(half_deg, 100, 80);
                const glm::dmat3 view{tests::view_from_enu(360.0 * unit(random), pitch_deg, 20.0)};
                const auto ranges =
                    frame.dome().visible(clip_from_enu(frustum, view) * frame.enu_from_mesh());
                const ImagePlane p = image_plane(frustum);
                for (int i = 0; i < 12; ++i) {
                    // The corners and edges of the picture are where culling would show first.
                    const double x = i < 4 ? static_cast<double>(i % 2) : unit(random);
                    const double y = i < 4 ? static_cast<double>(i / 2) : i < 8 ? 1.0 : unit(random);
                    const glm::dvec3 in_view{glm::mix(p.left, p.right, x), glm::mix(p.bottom, p.top, y),
                                             -1.0};
                    const auto index = light.pierced(glm::normalize(glm::transpose(view) * in_view));
                    ASSERT_TRUE(index);
                    const bool drawn =
                        std::any_of(ranges.begin(), ranges.end(), [&](const IndexRange& range) {
                            return *index >= range.first && *index < range.first + range.count;
                        });
                    EXPECT_TRUE(drawn) << half_deg << " " << pitch_deg << " " << x << " " << y;
                }
            }
        }
    }
}

TEST(DomePatches, AViewOfSixtyDegreesLeavesMostOfTheDomeOut) {
    SkyFrame frame({}, {});
    frame.prepare(tests::make_scene(40.0, 120.0, -30.0, 300.0, 500.0), 8e-4);
    std::size_t drawn = 0;
    for (const IndexRange& range :
         frame.dome().visible(clip_from_enu(tests::symmetric_frustum(30.0, 1280, 1024),
                                            glm::dmat3{tests::view_from_enu(120.0, 8.0, 0.0)}) *
                              frame.enu_from_mesh()))
        drawn += range.count;
    const double share = static_cast<double>(drawn) / static_cast<double>(frame.dome().indices().size());
    RecordProperty("share_of_triangles", std::to_string(share));
    EXPECT_LT(share, 0.4);
}

}  // namespace
}  // namespace skyig::render
