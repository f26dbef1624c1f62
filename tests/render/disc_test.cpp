// Discs of Sun and Moon: size, place, and the Moon's lit side.
#include <gtest/gtest.h>

#include <cmath>

#include "render/colour.h"
#include "render/night/moon_light.h"
#include "render/shaders/shared.h"
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

TEST_F(Disc, FullMoonIsWhiteAndNewMoonHidesInTwilight) {
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
        EXPECT_GT(full, 240);
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

TEST(MoonLight, PhaseFunctionHasItsClosedFormAndItsEnds) {
    using shaders64::lommel_seeliger_phase;
    EXPECT_DOUBLE_EQ(lommel_seeliger_phase(0.0), 1.0);
    EXPECT_NEAR(lommel_seeliger_phase(0.5 * std::numbers::pi), 0.3768, 5e-5);
    EXPECT_NEAR(lommel_seeliger_phase(std::numbers::pi), 0.0, 1e-12);
    for (double a = 0.001; a < 3.1; a += 0.01) {
        const double direct = 1.0 - std::sin(a / 2) * std::tan(a / 2) * std::log(1.0 / std::tan(a / 4));
        EXPECT_NEAR(lommel_seeliger_phase(a), direct, 2e-9) << a;
        EXPECT_GE(lommel_seeliger_phase(a), lommel_seeliger_phase(a + 0.01));
        EXPECT_NEAR(static_cast<double>(shaders32::lommel_seeliger_phase(static_cast<float>(a))),
                    lommel_seeliger_phase(a), 2e-5);
    }
}

TEST(MoonLight, DiscIntegratesToItsPhaseFunction) {
    for (const double phase : {0.2, 0.9, 1.57, 2.5}) {
        const glm::dvec3 sun{std::sin(phase), 0.0, std::cos(phase)};
        double sum = 0.0;
        constexpr int kSteps = 600;
        int inside = 0;
        for (int i = 0; i < kSteps; ++i) {
            for (int j = 0; j < kSteps; ++j) {
                const double x = (i + 0.5) * 2.0 / kSteps - 1.0;
                const double y = (j + 0.5) * 2.0 / kSteps - 1.0;
                const double rr = x * x + y * y;
                if (rr >= 1.0) continue;
                const glm::dvec3 normal{x, y, std::sqrt(1.0 - rr)};
                sum += shaders64::lommel_seeliger(glm::dot(normal, sun), normal.z);
                ++inside;
            }
        }
        EXPECT_NEAR(sum / inside, shaders64::lommel_seeliger_phase(phase), 3e-3) << phase;
    }
}

TEST(MoonLight, TintOnXyzIsTheTintOnRgb) {
    const glm::dvec3 white_xyz = glm::inverse(kRec709FromXyz) * glm::dvec3{1.0};
    const glm::dvec3 tinted = kRec709FromXyz * (white_xyz * night::moon_tint_xyz());
    EXPECT_LT(glm::length(tinted - night::moon_tint_rgb()), 1e-12);
    EXPECT_NEAR(night::moon_tint_xyz().y, 1.0, 1e-4) << "the tint changes no luminance";
}

TEST(MoonLight, FullMoonGivesAThirdOfALux) {
    EXPECT_NEAR(night::moon_illuminance_lux(8.0 * kDegree, 384400.0), 0.26, 0.02);
    EXPECT_NEAR(night::moon_illuminance_lux(0.0, 384400.0), 0.42, 0.02);
    for (double a = 0.0; a < 3.1; a += 0.05) {
        EXPECT_GT(night::moon_illuminance_lux(a, 384400.0), night::moon_illuminance_lux(a + 0.05, 384400.0));
    }
}

}  // namespace
}  // namespace skyig::render
