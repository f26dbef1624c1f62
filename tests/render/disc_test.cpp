// Discs of Sun and Moon: size, place, and the Moon's lit side.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

class Disc : public GlTest {};

constexpr int kSize = 256;

// Looks where the scene's air shows a body that stands at these angles without air.
Picture draw_towards(Scene scene, double azimuth_deg, double elevation_deg, double half_width_deg) {
    const double seen_rad = refraction_of(scene).apparent_from_true(elevation_deg * kDegree);
    add_view(scene, symmetric_frustum(half_width_deg, kSize, kSize),
             view_from_enu(azimuth_deg, seen_rad / kDegree, 0.0));
    DisplaySettings display;
    display.dither = false;
    Renderer renderer({{"only", kSize, kSize}}, display);
    renderer.prepare(scene);
    renderer.prepare(scene);
    Picture picture{kSize, kSize, std::vector<std::byte>(kSize * kSize * 4)};
    renderer.draw(0);
    renderer.read_back(0, picture.rgba);
    return picture;
}

TEST_F(Disc, SunHasItsAngularSize) {
    Scene scene = make_scene(30.0, 90.0, -50.0, 0.0, 0.0);
    scene.air.visibility_m = 200e3;
    const Picture picture = draw_towards(scene, 90.0, 30.0, 1.0);
    double area = 0.0;
    // Half way between the disc and the aureole two radii from its centre.
    const int aureole = picture.at(128 + 69, 128).g;
    ASSERT_LT(aureole, 245);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            area += 2 * picture.at(x, y).g > 255 + aureole ? 1.0 : 0.0;
    const double pixel = 2.0 * std::tan(1.0 * kDegree) / kSize;
    const double radius = std::sqrt(area / std::numbers::pi) * pixel;
    EXPECT_NEAR(radius / scene.sun.angular_radius_rad, 1.0, 0.02);
}

// Mean of the picture's left, right, upper and lower halves.
struct Halves {
    double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};
Halves halves_of(const Picture& picture) {
    Halves h;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            (x < kSize / 2 ? h.left : h.right) += picture.at(x, y).g;
            (y < kSize / 2 ? h.top : h.bottom) += picture.at(x, y).g;
        }
    }
    return h;
}

TEST_F(Disc, MoonIsLitFromTheSideOfTheSun) {
    for (const double sun_azimuth : {90.0, 270.0}) {
        Scene scene = make_scene(-20.0, sun_azimuth, 30.0, 180.0, 0.0);
        scene.stars.enabled = false;
        // As on a real sky the Sun is so far that from the Moon it stands where it stands from here.
        const Halves h = halves_of(draw_towards(scene, 180.0, 30.0, 0.4));
        const bool sun_is_left = sun_azimuth < 180.0;
        EXPECT_EQ(h.left > h.right, sun_is_left) << sun_azimuth;
        EXPECT_GT(h.bottom, h.top) << "the Sun is below the horizon, so the lower limb is lit";
    }
}

TEST_F(Disc, FullMoonIsBrightAndNewMoonHidesInTwilight) {
    // By night the Earth's light shows the new Moon; a bright dusk drowns it, and nothing of the Sun's light
    // may be left on its face.
    for (const double sun_elevation : {-30.0, -3.0}) {
        Scene scene = make_scene(sun_elevation, 0.0, 30.0, 180.0, 0.0);
        scene.stars.enabled = false;
        scene.moon.to_sun_enu = -scene.moon.direction_enu;
        scene.moon.phase_angle_rad = 0.0;
        const int full = draw_towards(scene, 180.0, 30.0, 0.4).at(128, 128).g;
        scene.moon.to_sun_enu = scene.moon.direction_enu;
        scene.moon.phase_angle_rad = std::numbers::pi;
        const int dark = draw_towards(scene, 180.0, 30.0, 0.4).at(128, 128).g;
        scene.moon.enabled = false;
        const int sky = draw_towards(scene, 180.0, 30.0, 0.4).at(128, 128).g;
        std::printf("sun at %5.1f deg: centre of the full Moon %d, of the new Moon %d, sky %d\n",
                    sun_elevation, full, dark, sky);
        EXPECT_GT(full, 185) << "a sea lies in the middle of the disc";
        EXPECT_GE(dark, sky - 1);
        if (sun_elevation > -10.0) {
            EXPECT_LE(dark, sky + 4);
        }
    }
}

TEST_F(Disc, SettingSunIsCutByTheHorizon) {
    const double true_deg = refraction_of({}).setting_elevation_rad() / kDegree;
    Scene scene = make_scene(true_deg, 270.0, -50.0, 0.0, 0.0);
    scene.air.visibility_m = 200e3;
    const Picture picture = draw_towards(scene, 270.0, true_deg, 1.0);
    EXPECT_GT(picture.at(128, 118).r, 250);
    EXPECT_LT(picture.at(128, 150).g, picture.at(128, 118).g - 20);
}

// New Moon before the Sun, which leaves over a share of its light that a test says.
Scene eclipse(double moon_from_sun_radius, double unobscured) {
    Scene scene = make_scene(40.0, 180.0, 40.0, 180.0, 0.0);
    scene.moon.angular_radius_rad = scene.sun.angular_radius_rad * moon_from_sun_radius;
    scene.moon.to_sun_enu = scene.moon.direction_enu;
    scene.moon.phase_angle_rad = std::numbers::pi;
    scene.sun.unobscured = unobscured;
    return scene;
}

TEST_F(Disc, NewMoonCoversTheSun) {
    Scene scene = eclipse(1.03, 1e-4);
    const Picture with = draw_towards(scene, 180.0, 40.0, 1.0);
    scene.moon.enabled = false;
    const Picture without = draw_towards(scene, 180.0, 40.0, 1.0);
    const Rgb covered = with.at(128, 128);
    std::printf("covered Sun: %d %d %d\n", covered.r, covered.g, covered.b);
    EXPECT_EQ(without.at(128, 128).r, 255);
    EXPECT_EQ(without.at(128, 128).b, 255);
    EXPECT_LT(std::max({covered.r, covered.g, covered.b}), 200);
    // Outside the Moon the corona shines.
    const double moon_px = std::tan(scene.moon.angular_radius_rad) / std::tan(1.0 * kDegree) * kSize / 2;
    int brightest = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (std::hypot(x + 0.5 - kSize / 2, y + 0.5 - kSize / 2) < moon_px - 1.0)
                brightest = std::max(brightest, with.at(x, y).g);
        }
    }
    EXPECT_LT(brightest, 200) << "the Sun looks out from behind the Moon";
}

TEST_F(Disc, SmallerMoonLeavesARing) {
    const Scene scene = eclipse(0.8, 0.36);
    const Picture picture = draw_towards(scene, 180.0, 40.0, 1.0);
    const double radius_px = std::tan(scene.sun.angular_radius_rad) / std::tan(1.0 * kDegree) * kSize / 2;
    const int ring = static_cast<int>(0.9 * radius_px);
    for (const auto& [x, y] : {std::pair{128 + ring, 128}, std::pair{127 - ring, 128},
                               std::pair{128, 128 + ring}, std::pair{128, 127 - ring}}) {
        EXPECT_EQ(picture.at(x, y).g, 255) << x << " " << y;
    }
    const int inside = picture.at(128, 128).g;
    const int outside = picture.at(128 + static_cast<int>(1.3 * radius_px), 128).g;
    std::printf("inside the ring %d, outside %d\n", inside, outside);
    EXPECT_LT(inside, 245);
    EXPECT_NEAR(inside, outside, 8);
}

}  // namespace
}  // namespace skyig::render
