// The same direction has the same colour in every channel that sees it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 640;
constexpr int kHeight = 512;

// Frustum whose outermost pixel centres, not edges, lie on the half angle.
Frustum centred_on_edge(double half_width_deg, int width_px, int height_px) {
    const double x = std::tan(half_width_deg * kDegree) * width_px / (width_px - 1);
    const double y = x * height_px / width_px;
    return {-std::atan(x), std::atan(x), -std::atan(y), std::atan(y)};
}

class Seam : public GlTest {};

TEST_F(Seam, CommonEdgeOfNeighboursDiffersByAtMostOneCode) {
    const std::vector<Channel> channels{
        {"left", kWidth, kHeight}, {"centre", kWidth, kHeight}, {"right", kWidth, kHeight}};
    const Frustum frustum = centred_on_edge(30.0, kWidth, kHeight);
    for (auto [name, scene] : four_times()) {
        const double yaw = name == "dawn" ? 150.0 : name == "dusk" ? 205.0 : name == "noon" ? 160.0 : 140.0;
        // Pitched so that horizon, Sun and Moon cross the seams; rolled so that no row follows the horizon.
        for (const double view_yaw : {-60.0, 0.0, 60.0}) {
            add_view(scene, frustum, view_from_enu(yaw, name == "night" ? 30.0 : 8.0, -12.0, view_yaw));
        }
        const auto pictures = draw(channels, scene, undithered());
        int worst = 0;
        for (std::size_t left = 0; left + 1 < pictures.size(); ++left) {
            for (int y = 0; y < kHeight; ++y) {
                worst = std::max(worst,
                                 difference(pictures[left].at(kWidth - 1, y), pictures[left + 1].at(0, y)));
            }
        }
        std::printf("%-6s largest difference on two seams: %d codes\n", name.c_str(), worst);
        EXPECT_LE(worst, 1) << name;
    }
}

TEST_F(Seam, SunMoonAndBrightStarOnTheSeamMatchToo) {
    const std::vector<Channel> channels{{"left", kWidth, kHeight}, {"right", kWidth, kHeight}};
    const Frustum frustum = centred_on_edge(30.0, kWidth, kHeight);
    for (const double sun_elevation : {10.0, 0.1}) {
        Scene scene = make_scene(sun_elevation, 180.0, 25.0, 180.0, 200.0);
        scene.moon.to_sun_enu = at(0.0, 90.0);
        scene.moon.phase_angle_rad = 1.5;
        add_view(scene, frustum, view_from_enu(150.0, 0.0, 0.0));
        add_view(scene, frustum, view_from_enu(210.0, 0.0, 0.0));
        const auto pictures = draw(channels, scene, undithered());
        int worst = 0;
        int brightest = 0;
        for (int y = 0; y < kHeight; ++y) {
            const Rgb left = pictures[0].at(kWidth - 1, y);
            worst = std::max(worst, difference(left, pictures[1].at(0, y)));
            brightest = std::max(brightest, left.g);
        }
        EXPECT_EQ(brightest, 255) << "the Sun is not on the seam";
        EXPECT_LE(worst, 1) << sun_elevation;
    }
}

TEST_F(Seam, WideViewAgreesWithTheNarrowOnesInItsPlane) {
    // One image plane cut in three: all pixels of the narrow views exist in the wide one.
    const double plane = std::tan(60.0 * kDegree);
    const Channel wide{"wide", 3 * kWidth, kHeight};
    const double half_height = plane / 3.0 * kHeight / kWidth;
    const Frustum all{-std::atan(plane), std::atan(plane), -std::atan(half_height), std::atan(half_height)};
    for (const auto& [name, scene] : four_times()) {
        const glm::dmat3 view = view_from_enu(name == "dusk" ? 235.0 : 150.0, 12.0, 9.0);
        Scene one = scene;
        add_view(one, all, view);
        Scene three = scene;
        std::vector<Channel> narrow;
        for (int i = 0; i < 3; ++i) {
            narrow.push_back({"narrow", kWidth, kHeight});
            add_view(three,
                     {std::atan(plane * (2.0 * i / 3.0 - 1.0)),
                      std::atan(plane * (2.0 * (i + 1) / 3.0 - 1.0)), all.bottom_rad, all.top_rad},
                     view);
        }
        const auto whole = draw({wide}, one, undithered());
        const auto parts = draw(narrow, three, undithered());
        int worst = 0;
        for (int part = 0; part < 3; ++part) {
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    worst = std::max(worst, difference(whole[0].at(part * kWidth + x, y),
                                                       parts[static_cast<std::size_t>(part)].at(x, y)));
                }
            }
        }
        std::printf("%-6s wide against three: %d codes\n", name.c_str(), worst);
        EXPECT_LE(worst, 1) << name;
    }
}

TEST_F(Seam, WideViewAgreesWithTurnedNarrowOnesWhereThePictureIsSmooth) {
    // The same angle per pixel on the axis in both rigs: edges are softened over it.
    const Channel wide{"wide", 3046, 1523};
    const Frustum all = symmetric_frustum(60.0, wide.width_px, wide.height_px);
    const std::vector<Channel> narrow(3, Channel{"narrow", kWidth, kHeight});
    const Frustum part = symmetric_frustum(20.0, kWidth, kHeight);
    for (const auto& [name, scene] : four_times()) {
        const double yaw = name == "dusk" ? 235.0 : 150.0;
        Scene one = scene;
        add_view(one, all, view_from_enu(yaw, 0.0, 0.0));
        Scene three = scene;
        three.stars.enabled = one.stars.enabled =
            false;  // their footprint follows each channel's own resolution
        for (const double turn : {-40.0, 0.0, 40.0})
            add_view(three, part, view_from_enu(yaw, 0.0, 0.0, turn));
        const auto whole = draw({wide}, one, undithered());
        const auto parts = draw(narrow, three, undithered());
        int worst = 0;
        int compared = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dmat3 wide_from_part =
                one.views[0].view_from_enu * glm::transpose(three.views[i].view_from_enu);
            for (int y = 3; y < kHeight; y += 7) {
                for (int x = 3; x < kWidth; x += 7) {
                    const glm::dvec3 d =
                        wide_from_part * view_direction(narrow[i], part, x + 0.5, kHeight - y - 0.5);
                    const ImagePlane plane = image_plane(all);
                    const double u =
                        (d.x / -d.z - plane.left) / (plane.right - plane.left) * wide.width_px - 0.5;
                    const double v =
                        (plane.top - d.y / -d.z) / (plane.top - plane.bottom) * wide.height_px - 0.5;
                    const int ux = static_cast<int>(std::floor(u));
                    const int vy = static_cast<int>(std::floor(v));
                    if (ux < 1 || vy < 1 || ux > wide.width_px - 3 || vy > wide.height_px - 3) continue;
                    const Rgb cell[4] = {whole[0].at(ux, vy), whole[0].at(ux + 1, vy),
                                         whole[0].at(ux, vy + 1), whole[0].at(ux + 1, vy + 1)};
                    Rgb low = cell[0], high = cell[0];
                    for (const Rgb& c : cell) {
                        low = {std::min(low.r, c.r), std::min(low.g, c.g), std::min(low.b, c.b)};
                        high = {std::max(high.r, c.r), std::max(high.g, c.g), std::max(high.b, c.b)};
                    }
                    if (difference(low, high) > 2) continue;  // an edge
                    const Rgb p = parts[i].at(x, y);
                    worst = std::max({worst, low.r - p.r, p.r - high.r, low.g - p.g, p.g - high.g,
                                      low.b - p.b, p.b - high.b});
                    ++compared;
                }
            }
        }
        std::printf("%-6s turned narrow views: %d codes over %d pixels\n", name.c_str(), worst, compared);
        EXPECT_GT(compared, 9000) << name;
        EXPECT_LE(worst, 1) << name;
    }
}

}  // namespace
}  // namespace skyig::render
