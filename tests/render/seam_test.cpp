// The same direction has the same colour in every channel that sees it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/geometry.h"
#include "render/night/star_catalogue.h"
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

// Clockwise from the nose, in the plane of the aircraft's wings.
double bearing_deg(const glm::dvec3& direction_enu, double yaw_deg, double pitch_deg, double roll_deg) {
    const glm::dvec3 d = body_from_ned(yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree) *
                         ned_from_enu() * direction_enu;
    return std::atan2(d.y, d.x) / kDegree;
}

// The yaw at which a pitched and rolled aircraft has a direction at a bearing.
double yaw_deg_that_puts(const glm::dvec3& direction_enu, double wanted_bearing_deg, double pitch_deg,
                         double roll_deg) {
    double yaw_deg = horizontal_of(direction_enu).azimuth_rad / kDegree - wanted_bearing_deg;
    for (int i = 0; i < 60; ++i)
        yaw_deg += bearing_deg(direction_enu, yaw_deg, pitch_deg, roll_deg) - wanted_bearing_deg;
    return yaw_deg;
}

int largest_difference_of_seam(const Picture& left, const Picture& right) {
    int worst = 0;
    for (int y = 0; y < left.height_px; ++y)
        worst = std::max(worst, difference(left.at(left.width_px - 1, y), right.at(0, y)));
    return worst;
}

// Asserts that a direction lies on the last column of a picture, and gives its row.
int row_on_last_column(const Channel& channel, const ChannelView& view, const glm::dvec3& direction_enu) {
    const glm::dvec2 point = picture_point(channel, view, direction_enu);
    EXPECT_NEAR(point.x, channel.width_px - 0.5, 0.01);
    EXPECT_GT(point.y, 30.0);
    EXPECT_LT(point.y, channel.height_px - 30.0);
    return std::clamp(static_cast<int>(point.y), 30, channel.height_px - 31);
}

// How much brighter a row of the last column is than its sky, the mean of what lies 12 px above and below.
double stands_out(const Picture& picture, int row) {
    const int x = picture.width_px - 1;
    return picture.at(x, row).g - 0.5 * (picture.at(x, row - 12).g + picture.at(x, row + 12).g);
}

TEST_F(Seam, CommonEdgeOfNeighboursDiffersByAtMostOneCodeWithABodyOnIt) {
    const std::vector<Channel> channels{
        {"left", kWidth, kHeight}, {"centre", kWidth, kHeight}, {"right", kWidth, kHeight}};
    const Frustum frustum = centred_on_edge(30.0, kWidth, kHeight);
    for (const auto& [name, scene] : four_times()) {
        const bool by_day = name == "dawn" || name == "noon";
        const glm::dvec3 body = seen(scene, by_day ? scene.sun.direction_enu : scene.moon.direction_enu);
        // Where the body is low, the horizon crosses the seams too; rolled so that no row follows it.
        const double pitch_deg = name == "noon" ? 48.0 : name == "night" ? 38.0 : 8.0;
        for (std::size_t seam = 0; seam < 2; ++seam) {
            const double yaw_deg = yaw_deg_that_puts(body, seam == 0 ? -30.0 : 30.0, pitch_deg, -12.0);
            Scene turned = scene;
            for (const double view_yaw : {-60.0, 0.0, 60.0})
                add_view(turned, frustum, view_from_enu(yaw_deg, pitch_deg, -12.0, view_yaw));
            const int row = row_on_last_column(channels[seam], turned.views[seam], body);
            const auto pictures = draw(channels, turned, undithered());
            const int bright = pictures[seam].at(kWidth - 1, row).g;
            const double above = stands_out(pictures[seam], row);
            const int worst = std::max(largest_difference_of_seam(pictures[0], pictures[1]),
                                       largest_difference_of_seam(pictures[1], pictures[2]));
            std::printf("%-6s seam %zu: %d codes at most; %s on it shows %d, %.1f above its sky\n",
                        name.c_str(), seam, worst, by_day ? "the Sun" : "the Moon", bright, above);
            EXPECT_GE(bright, by_day ? 240 : 160) << name;
            // Low in haze the Sun stands before an aureole that is nearly white.
            EXPECT_GE(above, by_day ? 4.0 : 70.0) << name;
            EXPECT_LE(worst, 1) << name;
        }
    }
}

TEST_F(Seam, SunAndMoonOnTheSeamMatchToo) {
    const std::vector<Channel> channels{{"left", kWidth, kHeight}, {"right", kWidth, kHeight}};
    const Frustum frustum = centred_on_edge(30.0, kWidth, kHeight);
    for (const double sun_elevation : {1.0, 0.1}) {
        Scene scene = make_scene(sun_elevation, 180.0, 15.0, 180.0, 200.0);
        // Lit from the east and from here, so that the lit part lies on the seam.
        scene.moon.to_sun_enu = -std::cos(0.5) * scene.moon.direction_enu + std::sin(0.5) * at(0.0, 90.0);
        scene.moon.phase_angle_rad = 0.5;
        add_view(scene, frustum, view_from_enu(150.0, 0.0, 0.0));
        add_view(scene, frustum, view_from_enu(210.0, 0.0, 0.0));
        const auto pictures = draw(channels, scene, undithered());
        const int sun_row =
            row_on_last_column(channels[0], scene.views[0], seen(scene, scene.sun.direction_enu));
        const int moon_row =
            row_on_last_column(channels[0], scene.views[0], seen(scene, scene.moon.direction_enu));
        const int worst = largest_difference_of_seam(pictures[0], pictures[1]);
        const double moon_above = stands_out(pictures[0], moon_row);
        std::printf("sun at %.1f deg: %d codes at most; the Moon shows %.1f above its sky\n", sun_elevation,
                    worst, moon_above);
        EXPECT_EQ(pictures[0].at(kWidth - 1, sun_row).r, 255) << "the Sun is not on the seam";
        EXPECT_GE(moon_above, 3) << "the Moon is not on the seam";
        EXPECT_LE(worst, 1) << sun_elevation;
    }
}

TEST_F(Seam, BrightStarOnTheSeamMatchesToo) {
    const std::vector<Channel> channels{{"left", kWidth, kHeight}, {"right", kWidth, kHeight}};
    const Frustum frustum = centred_on_edge(30.0, kWidth, kHeight);
    const night::CatalogueStar* sirius = night::find_star(2491);
    ASSERT_NE(sirius, nullptr);
    for (const double elevation : {3.0, 15.0}) {
        Scene scene = make_scene(-35.0, 0.0, -30.0, 90.0, 200.0);
        const glm::dvec3 place = at(elevation, 180.0);
        scene.stars.enu_from_gcrs =
            rotation_between(glm::normalize(glm::dvec3{sirius->direction_gcrs}), place);
        add_view(scene, frustum, view_from_enu(150.0, 0.0, 0.0));
        add_view(scene, frustum, view_from_enu(210.0, 0.0, 0.0));
        const auto pictures = draw(channels, scene, undithered());
        const int row = row_on_last_column(channels[0], scene.views[0], seen(scene, place));
        const int worst = largest_difference_of_seam(pictures[0], pictures[1]);
        const double above = stands_out(pictures[0], row);
        std::printf("Sirius at %.0f deg: %d codes at most; it shows %.1f above its sky\n", elevation, worst,
                    above);
        EXPECT_GE(above, 60) << elevation;
        EXPECT_LE(worst, 1) << elevation;
    }
}

TEST_F(Seam, WavesRunOnAcrossIt) {
    const std::vector<Channel> channels{{"left", kWidth, kHeight}, {"right", kWidth, kHeight}};
    const Frustum frustum = centred_on_edge(30.0, kWidth, kHeight);
    for (const double height_m : {20.0, 600.0}) {
        Scene scene = make_scene(35.0, 180.0, -30.0, 90.0, height_m);
        add_waves(scene);
        scene.time_s = 12.3;
        for (const double yaw_deg : {150.0, 210.0})
            add_view(scene, frustum, view_from_enu(yaw_deg, 0.0, 0.0));
        const auto pictures = draw(channels, scene, undithered());
        int contrast = 0;
        for (int y = 4; y < kHeight; ++y) {
            contrast = std::max(contrast,
                                difference(pictures[0].at(kWidth - 1, y), pictures[0].at(kWidth - 1, y - 4)));
        }
        const int worst = largest_difference_of_seam(pictures[0], pictures[1]);
        std::printf("waves from %.0f m: %d codes at most; they step by %d\n", height_m, worst, contrast);
        EXPECT_GE(contrast, 5) << "no waves on the seam";
        EXPECT_LE(worst, 1) << height_m;
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
