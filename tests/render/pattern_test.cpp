// Test patterns as they are read back, against directions computed in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "render/gl/objects.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/warps.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 960;
constexpr int kHeight = 768;
constexpr double kStep_deg = 5.0;

struct Look {
    const char* name;
    Frustum frustum;
    double azimuth_deg, elevation_deg, roll_deg;
};

Frustum sides(double left_deg, double right_deg, double bottom_deg, double top_deg) {
    return {left_deg * kDegree, right_deg * kDegree, bottom_deg * kDegree, top_deg * kDegree};
}

std::vector<Look> looks() {
    return {{"60 deg", sides(-30.0, 30.0, -24.8, 24.8), 0.0, 0.0, 0.0},
            {"off axis", sides(-5.0, 48.0, -12.0, 33.0), 123.0, 4.0, 0.0},
            {"strongly off axis", sides(20.0, 65.0, -40.0, -5.0), 250.0, -3.0, 2.0},
            {"turned", sides(-30.0, 30.0, -24.8, 24.8), 181.0, 25.0, 37.0},
            {"narrow", sides(-6.0, 6.0, -4.8, 4.8), 359.0, -20.0, -10.0},
            {"wide", sides(-55.0, 55.0, -48.8, 48.8), 77.0, 10.0, 5.0}};
}

class PatternTest : public GlTest {
  protected:
    static Scene scene_of(const Look& look, Pattern pattern) {
        Scene scene = make_scene(30.0, 120.0, -30.0, 0.0, 1000.0);
        add_view(scene, look.frustum, view_from_enu(look.azimuth_deg, look.elevation_deg, look.roll_deg));
        scene.views[0].pattern = pattern;
        return scene;
    }
    Picture draw_pattern(const Look& look, Pattern pattern) {
        return draw(renderer_, scene_of(look, pattern))[0];
    }
    [[nodiscard]] glm::dvec3 direction(const Scene& scene, double x_px, double y_down_px) const {
        return glm::transpose(scene.views[0].view_from_enu) *
               view_direction(channels_[0], scene.views[0].frustum, x_px, kHeight - y_down_px);
    }

    std::vector<Channel> channels_{{"left", kWidth, kHeight}};
    Renderer renderer_{channels_, undithered()};
};

struct Angles {
    double azimuth_deg, elevation_deg;
};

Angles angles_of(const glm::dvec3& d) {
    return {std::atan2(d.x, d.y) / kDegree, std::atan2(d.z, std::hypot(d.x, d.y)) / kDegree};
}

double off_line_deg(double angle_deg) {
    return std::abs(angle_deg - kStep_deg * std::round(angle_deg / kStep_deg));
}

/// Angle on the sphere to the nearest line of either kind.
double off_lines_deg(const glm::dvec3& d) {
    const Angles a = angles_of(d);
    return std::min(off_line_deg(a.elevation_deg),
                    off_line_deg(a.azimuth_deg) * std::cos(a.elevation_deg * kDegree));
}

/// Where the horizon is marked, and where fields narrow towards a pole, edges are no edges of fields.
bool plain_fields(const glm::dvec3& d) {
    const double elevation_deg = std::abs(angles_of(d).elevation_deg);
    return elevation_deg > 0.6 && elevation_deg < 75.0;
}

struct Edges {
    int count = 0;
    double largest_deg = 0.0;
    double sum2 = 0.0;
};

/// How far the edges of a checker's picture lie from whole five degrees.
/// \param direction  of a place of the picture in pixels, right and down from its upper left corner
template <class Direction>
Edges edges_of(const Picture& picture, const Direction& direction) {
    Edges edges;
    const auto measure = [&](int x, int y, int next_x, int next_y) {
        const double here = picture.at(x, y).r - 127.5, there = picture.at(next_x, next_y).r - 127.5;
        // Only whole edges: corners of four fields are grey.
        if (here * there >= 0.0 || std::abs(here - there) < 120.0) return;
        const double share = here / (here - there);
        const glm::dvec3 d = direction(x + 0.5 + share * (next_x - x), y + 0.5 + share * (next_y - y));
        if (!plain_fields(d)) return;
        const double off_deg = off_lines_deg(d);
        edges.largest_deg = std::max(edges.largest_deg, off_deg);
        edges.sum2 += off_deg * off_deg;
        ++edges.count;
    };
    // The channel's name stands in the lower left corner.
    for (int y = 0; y < kHeight - 60; y += 7) {
        for (int x = 0; x + 1 < kWidth; ++x)
            measure(x, y, x + 1, y);
    }
    for (int x = 0; x < kWidth; x += 7) {
        for (int y = 0; y + 1 < kHeight - 60; ++y)
            measure(x, y, x, y + 1);
    }
    return edges;
}

void expect_in_place(const Edges& edges, const char* name) {
    std::printf("%-18s %5d edges: off by %.4f deg (rms), %.4f at most\n", name, edges.count,
                std::sqrt(edges.sum2 / std::max(edges.count, 1)), edges.largest_deg);
    EXPECT_GT(edges.count, 200) << name;
    EXPECT_LE(edges.largest_deg, 0.05) << name;
}

TEST_F(PatternTest, EdgesOfTheCheckerLieAtWholeFiveDegrees) {
    for (const Look& look : looks()) {
        const Scene scene = scene_of(look, Pattern::kChecker);
        expect_in_place(
            edges_of(draw_pattern(look, Pattern::kChecker),
                     [&](double x_px, double y_down_px) { return direction(scene, x_px, y_down_px); }),
            look.name);
    }
}

// The truth is the cylinder's geometry, not the mesh that the warp is made of.
TEST_F(PatternTest, EdgesOfTheCheckerLieAtWholeFiveDegreesThroughACurvedScreen) {
    const CurvedScreen curved;
    Channel channel{"left", kWidth, kHeight};
    channel.warp = curved.warp(kWidth, kHeight);
    for (const auto& [name, drawing] : {std::pair{"curved, direct", WarpDrawing::kDirect},
                                        {"curved, resampled", WarpDrawing::kResampled}}) {
        channel.drawing = drawing;
        channel.render_scale = drawing == WarpDrawing::kResampled ? 1.5 : 1.0;
        Renderer renderer({channel}, undithered());
        for (const auto& [azimuth_deg, elevation_deg, roll_deg] :
             {std::array{0.0, 5.0, 0.0}, {140.0, -12.0, 20.0}}) {
            Look look{name, curved.frustum(), azimuth_deg, elevation_deg, roll_deg};
            const Scene scene = scene_of(look, Pattern::kChecker);
            const glm::dmat3 enu_from_view = glm::transpose(scene.views[0].view_from_enu);
            expect_in_place(
                edges_of(
                    draw(renderer, scene)[0],
                    [&](double x_px, double y_down_px) {
                        return enu_from_view * curved.direction({x_px / kWidth, 1.0 - y_down_px / kHeight});
                    }),
                name);
        }
    }
}

// What a view first wants in the middle of a flight holds no frame up.
TEST_F(PatternTest, OnceReadyAPatternATextAndAResampledChannelMakeNoObject) {
    const CurvedScreen curved;
    Channel warped{"warped", kWidth, kHeight};
    warped.warp = curved.warp(kWidth, kHeight);
    warped.drawing = WarpDrawing::kResampled;
    Renderer renderer({{"flat", kWidth, kHeight}, warped}, undithered());
    renderer.make_ready();
    Scene scene = scene_of(looks()[0], Pattern::kOff);
    add_view(scene, curved.frustum(), view_from_enu(0.0, 5.0, 0.0));
    renderer.prepare(scene);
    renderer.draw(0);
    const std::size_t before = gl::count_objects();
    scene.views[0].pattern = Pattern::kChecker;
    scene.views[1].overlay = 1;
    scene.overlay.lines[0].say("a line");
    renderer.prepare(scene);
    renderer.draw(0);
    renderer.draw(1);
    EXPECT_EQ(gl::count_objects(), before);
    EXPECT_EQ(renderer.gl_errors(), 0U);
}

TEST_F(PatternTest, FieldsOfTheCheckerTakeTurns) {
    for (const Look& look : looks()) {
        const Scene scene = scene_of(look, Pattern::kChecker);
        const Picture picture = draw_pattern(look, Pattern::kChecker);
        int fields = 0;
        for (int row = -14; row < 14; ++row) {
            for (int column = 0; column < 72; ++column) {
                const glm::dvec3 d = at((row + 0.5) * kStep_deg, (column + 0.5) * kStep_deg);
                if ((scene.views[0].view_from_enu * d).z > -0.05) continue;
                const glm::dvec2 place = picture_point(channels_[0], scene.views[0], d);
                if (place.x < 5 || place.x > kWidth - 5 || place.y < 5 || place.y > kHeight - 60) continue;
                const bool white = (row + column) % 2 == 0;
                EXPECT_EQ(picture.at(static_cast<int>(place.x), static_cast<int>(place.y)).r, white ? 255 : 0)
                    << look.name << ' ' << row << ' ' << column;
                ++fields;
            }
        }
        EXPECT_GE(fields, 2) << look.name;
    }
}

TEST_F(PatternTest, SeamLinesOfOverlappingChannelsLieInTheSameDirections) {
    Scene scene = make_scene(30.0, 120.0, -30.0, 0.0, 1000.0);
    const Frustum frustum = sides(-30.0, 30.0, -24.8, 24.8);
    add_view(scene, frustum, view_from_enu(10.0, 0.0, 0.0));
    add_view(scene, frustum, view_from_enu(50.0, 8.0, 12.0));
    scene.views[0].pattern = scene.views[1].pattern = Pattern::kSeam;
    const std::vector<Channel> channels{{"left", kWidth, kHeight}, {"right", kWidth, kHeight}};
    const auto pictures = draw(channels, scene, undithered());
    const auto code = [&](std::size_t i, const glm::dvec3& d) {
        const glm::dvec2 place = picture_point(channels[i], scene.views[i], d);
        const bool inside = place.x > 20 && place.x < kWidth - 20 && place.y > 20 && place.y < kHeight - 60;
        const Rgb rgb =
            inside ? pictures[i].at(static_cast<int>(place.x), static_cast<int>(place.y)) : Rgb{-1, -1, -1};
        return std::max({rgb.r, rgb.g, rgb.b});
    };
    int on_lines = 0;
    for (int i = 0; i < 4000; ++i) {
        const double along_deg = 0.013 * i;
        const double line_deg = 2.5 * (i % 40 - 20);
        for (const glm::dvec3& d : {at(line_deg, along_deg), at(along_deg - 20.0, line_deg)}) {
            if ((scene.views[0].view_from_enu * d).z > -0.05 || (scene.views[1].view_from_enu * d).z > -0.05)
                continue;
            const int left = code(0, d), right = code(1, d);
            if (left < 0 || right < 0) continue;
            // The middle of the pixel that holds a point of a line is 0.71 pixels from it at most.
            EXPECT_GE(left, 70) << line_deg << ' ' << along_deg;
            EXPECT_GE(right, 70) << line_deg << ' ' << along_deg;
            ++on_lines;
        }
        const glm::dvec3 between = at(1.25 + 2.5 * (i % 7 - 3), 15.7 + 2.5 * (i % 11));
        if (const int left = code(0, between), right = code(1, between); left >= 0 && right >= 0) {
            EXPECT_EQ(left, 0);
            EXPECT_EQ(right, 0);
        }
    }
    EXPECT_GT(on_lines, 300);
    // Edges in colours of their own.
    EXPECT_GT(pictures[0].at(2, 100).r, pictures[0].at(2, 100).g);
    EXPECT_GT(pictures[1].at(2, 100).g, pictures[1].at(2, 100).r);
}

TEST_F(PatternTest, ResolutionBarsAreOneToFourPixelsWide) {
    const Picture picture = draw_pattern(looks()[0], Pattern::kResolution);
    std::array<int, 5> across{}, upright{};
    for (int cell_y = 0; cell_y < 12; ++cell_y) {
        for (int cell_x = 0; cell_x < 12; ++cell_x) {
            // Cells count from the lower left corner.
            const int x0 = 48 * cell_x, y0 = kHeight - 1 - 48 * cell_y;
            const bool turns_across = picture.at(x0, y0).r != picture.at(x0 + 4, y0).r ||
                                      picture.at(x0, y0).r != picture.at(x0 + 2, y0).r ||
                                      picture.at(x0, y0).r != picture.at(x0 + 1, y0).r ||
                                      picture.at(x0, y0).r != picture.at(x0 + 3, y0).r;
            int width = 0;
            const auto along = [&](int i) {
                return turns_across ? picture.at(x0 + i, y0).r : picture.at(x0, y0 - i).r;
            };
            while (width < 48 && along(width) == along(0))
                ++width;
            ASSERT_LE(width, 4);
            for (int i = 0; i < 48; ++i)
                ASSERT_EQ(along(i), (i / width) % 2 == 0 ? 0 : 255) << cell_x << ' ' << cell_y << ' ' << i;
            ++(turns_across ? across : upright)[static_cast<std::size_t>(width)];
        }
    }
    for (std::size_t width = 1; width <= 4; ++width) {
        EXPECT_GT(across[width], 0) << width;
        EXPECT_GT(upright[width], 0) << width;
    }
}

double light_of(double code, const Screen& screen) {
    if (!screen.srgb) return std::pow(code, screen.gamma);
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

TEST_F(PatternTest, HalftonesOfTheRampGiveTheLightOfItsCodes) {
    for (const bool srgb : {true, false}) {
        DisplaySettings display = undithered();
        display.srgb = srgb;
        display.gamma = 2.5;
        const Picture picture = draw(channels_, scene_of(looks()[0], Pattern::kRamp), display)[0];
        double largest = 0.0;
        for (int step = 0; step <= 16; ++step) {
            const int left = (2 * step + 1) * kWidth / 34 / 4 * 4 - 8;
            const auto mean = [&](int top) {
                double sum = 0.0;
                for (int y = 0; y < 16; ++y) {
                    for (int x = 0; x < 16; ++x)
                        sum += light_of(picture.at(left + x, top + y).r / 255.0, display);
                }
                return sum / 256.0;
            };
            const double solid = mean(kHeight / 6), halftone = mean(kHeight / 2);
            EXPECT_DOUBLE_EQ(halftone, step / 16.0) << step;
            largest = std::max(largest, std::abs(solid - halftone));
            EXPECT_NEAR(picture.at(left, kHeight - 1 - kHeight / 6).r, 255.0 * step / 16.0, 1.0);
        }
        std::printf("%s: solid codes and halftones differ by %.4f of white at most\n", srgb ? "sRGB" : "2.5",
                    largest);
        // Half a code at white.
        EXPECT_LE(largest, 0.5 * 2.5 / 255.0);
    }
}

TEST_F(PatternTest, FlatPatternsAreFlatAndCarryNoText) {
    for (const auto& [pattern, code] :
         {std::pair{Pattern::kWhite, 255}, {Pattern::kBlack, 0}, {Pattern::kGrey, 188}}) {
        const Picture picture = draw_pattern(looks()[0], pattern);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x)
                ASSERT_LE(difference(picture.at(x, y), {code, code, code}), 0) << x << ' ' << y;
        }
    }
}

TEST_F(PatternTest, SkyComesBackAsItWasAndOtherChannelsKeepIt) {
    Scene scene = make_scene(30.0, 120.0, -30.0, 0.0, 1000.0);
    const Frustum frustum = sides(-30.0, 30.0, -24.8, 24.8);
    add_view(scene, frustum, view_from_enu(110.0, 5.0, 0.0));
    add_view(scene, frustum, view_from_enu(110.0, 5.0, 0.0));
    const std::vector<Channel> channels{{"a", 160, 128}, {"b", 160, 128}};
    Renderer renderer(channels, undithered());
    const auto before = draw(renderer, scene);
    scene.views[0].pattern = Pattern::kGrid;
    const auto during = draw(renderer, scene);
    scene.views[0].pattern = Pattern::kOff;
    const auto after = draw(renderer, scene);
    EXPECT_EQ(before[0].rgba, after[0].rgba);
    EXPECT_EQ(before[1].rgba, during[1].rgba);
    EXPECT_NE(before[0].rgba, during[0].rgba);
    EXPECT_FALSE(renderer.prepare(scene).plan.needs(Pass::kPattern));
}

}  // namespace
}  // namespace skyig::render
