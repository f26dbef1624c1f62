// The warp's two ways against each other and against known geometry.
#include "render/warp/warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "render/rig_geometry.h"
#include "tests/render/warps.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 1280;
constexpr int kHeight = 1024;
const glm::dvec2 kSize_px{kWidth, kHeight};

// Keystone, a barrel and a shear together, as a camera would have measured it.
glm::dvec2 crooked(const glm::dvec2& screen) {
    const glm::dvec2 at = 2.0 * screen - 1.0;
    const double keystone = 1.0 + 0.12 * at.y;
    const double barrel = 1.0 - 0.06 * glm::dot(at, at);
    return 0.5 + 0.45 * glm::dvec2{at.x / keystone, at.y + 0.04 * at.x} * barrel;
}

double worst_inverse_px(const warp::Warp& warp) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    double worst = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec2 screen{part(random), part(random)};
        worst = std::max(worst, glm::length((warp.drawn_at(warp.picture_of(screen)) - screen) * kSize_px));
    }
    return worst;
}

TEST(Warp, InverseHoldsWithinATenthOfAPixel) {
    const double curved = worst_inverse_px(*CurvedScreen{}.warp(kWidth, kHeight));
    const double wide = worst_inverse_px(*CurvedScreen{55.0 * kDegree, 0.6}.warp(kWidth, kHeight));
    const double coarse = worst_inverse_px(*CurvedScreen{}.warp(kWidth, kHeight, 17, 13));
    const double bent = worst_inverse_px(warp::Warp(mesh_of(33, 33, crooked), kWidth, kHeight));
    std::printf("inverse: %.4f px curved, %.4f px of 110 deg, %.4f px with 17x13 nodes, %.4f px crooked\n",
                curved, wide, coarse, bent);
    for (const double worst : {curved, wide, coarse, bent})
        EXPECT_LT(worst, 0.1);
}

TEST(Warp, SolvedInverseIsExact) {
    const auto warp = CurvedScreen{}.warp(kWidth, kHeight);
    for (const glm::dvec2 screen : {glm::dvec2{0.0, 0.0}, {1.0, 0.5}, {0.31, 0.92}, {0.5, 0.5}}) {
        const auto found = warp->screen_of(warp->picture_of(screen));
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->x, screen.x, 1e-7);
        EXPECT_NEAR(found->y, screen.y, 1e-7);
    }
    EXPECT_FALSE(warp->screen_of({40.0, 0.5}));
}

TEST(Warp, SplineThroughNodesFollowsTheSurface) {
    const CurvedScreen curved;
    const auto worst_px = [&](int columns, int rows) {
        double worst = 0.0;
        const auto warp = curved.warp(kWidth, kHeight, columns, rows);
        for (int i = 0; i < 101 * 101; ++i) {
            const glm::dvec2 screen = glm::dvec2{i % 101, i / 101} / 100.0;
            worst = std::max(worst,
                             glm::length((warp->picture_of(screen) - curved.picture_of(screen)) * kSize_px));
        }
        return worst;
    };
    const double coarse = worst_px(17, 13);
    const double usual = worst_px(33, 25);
    std::printf("nodes of a curved screen: 17x13 %.3f px off it, 33x25 %.3f px\n", coarse, usual);
    EXPECT_LT(coarse, 0.5);
    EXPECT_LT(usual, 0.1);
}

TEST(Warp, NodesOnTheEdgesAndInTheMiddleOfTheirShareDiffer) {
    warp::Mesh mesh{2, 2, true, {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 1.0F}}};
    EXPECT_NEAR(warp::Warp(mesh, kWidth, kHeight).picture_of({0.25, 0.75}).x, 0.25, 1e-12);
    EXPECT_TRUE(warp::Warp(mesh, kWidth, kHeight).is_identity());
    mesh.at_edges = false;  // nodes at a quarter and three quarters
    EXPECT_NEAR(warp::Warp(mesh, kWidth, kHeight).picture_of({0.25, 0.75}).x, 0.0, 1e-12);
    EXPECT_NEAR(warp::Warp(mesh, kWidth, kHeight).picture_of({0.5, 0.75}).y, 1.0, 1e-12);
}

TEST(Warp, IdentityMovesNothingAtAll) {
    const auto warp = identity_warp(kWidth, kHeight);
    EXPECT_TRUE(warp->is_identity());
    for (const glm::vec4& node : warp->nodes())
        ASSERT_EQ(node, (glm::vec4{0.0F, 0.0F, 1.0F, 0.0F}));
    EXPECT_FALSE(CurvedScreen{}.warp(kWidth, kHeight)->is_identity());
}

TEST(Warp, PixelsOfACurvedScreenAreAsLargeAsItsGeometrySays) {
    const CurvedScreen curved;
    const Channel channel{
        .name = "curved", .width_px = kWidth, .height_px = kHeight, .warp = curved.warp(kWidth, kHeight)};
    const ChannelView view{curved.frustum(), glm::dmat3{1.0}};
    const RigField field = rig_field({&channel, 1}, {&view, 1});
    // Even angles across, on the middle row.
    const double across_rad = 2.0 * curved.half_azimuth_rad / kWidth;
    const double upright_rad = 2.0 * std::atan(curved.half_height / kHeight);
    EXPECT_NEAR(field.channels[0].centre_pixel_rad, std::max(across_rad, upright_rad), 1e-6);
    EXPECT_LT(longest_edge_rad(channel, view.frustum), 8.0 * kDegree);
    EXPECT_GE(longest_edge_rad(channel, view.frustum), 2.0 * kDegree);
}

}  // namespace
}  // namespace skyig::render
