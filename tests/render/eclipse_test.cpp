// Eclipses of the Moon and of the Sun in the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/night/moon_light.h"
#include "render/shaders/shared.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/light_tables_steps.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kSize = 200;

// The full Moon in the south at midnight, the shadow's axis that many of its radii to the west.
Scene lunar_eclipse(double axis_radii, double sunlit) {
    Scene scene = make_scene(-40.0, 0.0, 40.0, 180.0, 0.0);
    scene.stars.enabled = false;
    scene.moon.to_sun_enu = -scene.moon.direction_enu;
    scene.moon.phase_angle_rad = 0.004;
    scene.moon.shadow_axis_enu = {-axis_radii, 0.0, 0.0};
    scene.moon.sunlit = sunlit;
    return scene;
}

class Eclipse : public GlTest {
  protected:
    Picture towards(Scene scene, const glm::dvec3& body, double half_width_deg) {
        const Horizontal at = horizontal_of(seen(scene, body));
        add_view(scene, symmetric_frustum(half_width_deg, kSize, kSize),
                 view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 0.0));
        // A jump of the clock: nothing of the scene before is left in the adaptation.
        scene.time_s = time_s_ += 100.0;
        return draw(renderer_, scene)[0];
    }
    Renderer renderer_{{{"only", kSize, kSize}}, undithered()};
    double time_s_ = 0.0;

    // Pixels across the Moon's disc in that view.
    static constexpr double kHalfWidth_deg = 0.4;
    static double radius_px(const Scene& scene) {
        return std::tan(scene.moon.angular_radius_rad) / std::tan(kHalfWidth_deg * kDegree) * kSize / 2;
    }
};

TEST(EarthShadow, SunlightFallsThroughThePenumbraToCopperInTheUmbra) {
    double last = 2.0;
    for (double d = 6.0; d >= 0.0; d -= 0.01) {
        const auto sun = shaders64::sun_in_shadow(d, 2.6, 4.7);
        const double light = sun.direct + shaders64::luminance_709(sun.refracted);
        EXPECT_LE(light, last + 1e-12) << d;
        last = light;
        if (d < 2.59) {
            EXPECT_EQ(sun.direct, 0.0) << d;
            EXPECT_GT(sun.refracted.x, 1.8 * sun.refracted.y) << d;
            EXPECT_GT(sun.refracted.y, 1.8 * sun.refracted.z) << d;
        }
    }
    const auto axis = shaders64::sun_in_shadow(0.0, 2.6, 4.7);
    const auto edge = shaders64::sun_in_shadow(2.6, 2.6, 4.7);
    EXPECT_NEAR(shaders64::luminance_709(axis.refracted), 1e-5, 2e-7);
    EXPECT_NEAR(shaders64::luminance_709(edge.refracted), 1e-4, 3e-6);
    EXPECT_EQ(shaders64::sun_in_shadow(4.71, 2.6, 4.7).direct, 1.0);
    // Mean over the umbra: what moonlight keeps at mid-eclipse.
    double sum = 0.0, area = 0.0;
    for (double d = 0.005; d < 2.6; d += 0.01) {
        sum += shaders64::luminance_709(shaders64::sun_in_shadow(d, 2.6, 4.7).refracted) * d;
        area += d;
    }
    std::printf("mean over the umbra: %.3g\n", sum / area);
    EXPECT_NEAR(sum / area / 4e-5, 1.0, 0.1);
}

TEST_F(Eclipse, PartlyEclipsedMoonIsBittenWithASoftEdge) {
    const Scene scene = lunar_eclipse(2.6, 0.3);
    const Picture picture = towards(scene, scene.moon.direction_enu, kHalfWidth_deg);
    const double radius = radius_px(scene);
    const auto across = [&](double radii) { return picture.at(100 + static_cast<int>(radii * radius), 100); };
    // The axis lies to the west, right of a Moon in the south.
    const Rgb lit = across(-0.9);
    const Rgb dark = across(0.8);
    std::printf("lit limb %d %d %d, in the umbra %d %d %d\n", lit.r, lit.g, lit.b, dark.r, dark.g, dark.b);
    EXPECT_GT(std::min({lit.r, lit.g, lit.b}), 170);
    EXPECT_GT(dark.r, dark.g + 30) << "a sea, which is darker than the land";
    EXPECT_GT(dark.g, dark.b);
    EXPECT_LT(dark.g, lit.g - 60);
    int largest_step = 0;
    for (double at = -0.9; at < 0.9; at += 1.0 / radius)
        largest_step = std::max(largest_step, difference(across(at), across(at + 1.0 / radius)));
    std::printf("largest step from pixel to pixel: %d codes\n", largest_step);
    EXPECT_LT(largest_step, 60);
}

TEST_F(Eclipse, TotallyEclipsedMoonIsCopperAndItsSkyDark) {
    const Scene total = lunar_eclipse(0.4, 0.0);
    const Picture picture = towards(total, total.moon.direction_enu, kHalfWidth_deg);
    const double radius = radius_px(total);
    for (const double x : {-0.8, -0.3, 0.0, 0.5, 0.8}) {
        const Rgb p = picture.at(100 + static_cast<int>(x * radius), 100);
        EXPECT_GT(p.r, p.g + 60) << x;
        EXPECT_GT(p.g, p.b + 10) << x;
    }
    LightTables tables;
    const double eclipsed = luminance(step(tables, total), 60, 0);
    const double full = luminance(step(tables, lunar_eclipse(9.0, 1.0)), 60, 0);
    Scene none = total;
    none.moon.direction_enu = at(-40.0, 0.0);
    const double dark = luminance(step(tables, none), 60, 0);
    std::printf("sky: full Moon %.3g, eclipsed %.3g, no Moon %.3g cd/m2\n", full, eclipsed, dark);
    EXPECT_LT(eclipsed / dark, 1.02);
    EXPECT_GT(full / dark, 10.0);
}

TEST_F(Eclipse, MoonOutsideTheShadowIsAsIfThereWereNone) {
    Scene scene = lunar_eclipse(6.0, 1.0);
    const Picture near = towards(scene, scene.moon.direction_enu, kHalfWidth_deg);
    scene.moon.shadow_axis_enu = {1e3, 0.0, 0.0};
    EXPECT_EQ(near.rgba, towards(scene, scene.moon.direction_enu, kHalfWidth_deg).rgba);
}

Scene solar_eclipse(double unobscured) {
    Scene scene = make_scene(40.0, 180.0, 40.0, 180.0, 0.0);
    scene.stars.enabled = false;
    scene.moon.angular_radius_rad = scene.sun.angular_radius_rad * 1.04;
    scene.moon.to_sun_enu = scene.moon.direction_enu;
    scene.moon.phase_angle_rad = std::numbers::pi;
    scene.sun.unobscured = unobscured;
    return scene;
}

TEST_F(Eclipse, CoronaStandsRoundTheDarkMoonOnlyInTotality) {
    const Scene total = solar_eclipse(0.0);
    const Picture picture = towards(total, total.sun.direction_enu, 1.5);
    const double sun_px = std::tan(total.sun.angular_radius_rad) / std::tan(1.5 * kDegree) * kSize / 2;
    const auto from_centre = [&](double radii) {
        return picture.at(100 + static_cast<int>(radii * sun_px), 100).g;
    };
    std::printf("centre %d; 1.3 radii %d, 2 radii %d, 4 radii %d\n", from_centre(0.0), from_centre(1.3),
                from_centre(2.0), from_centre(4.0));
    EXPECT_GT(from_centre(1.3), from_centre(0.0) + 60);
    EXPECT_GE(from_centre(1.3), from_centre(2.0));
    EXPECT_GT(from_centre(2.0), from_centre(4.0) + 15);
    // It comes without a step and is not planned where the disc outshines it.
    EXPECT_FALSE(make_plan(solar_eclipse(0.03), {}, refraction_of(total)).needs(Pass::kCorona));
    EXPECT_LT(make_plan(solar_eclipse(0.0199), {}, refraction_of(total)).corona_share, 1e-3);
    EXPECT_EQ(make_plan(total, {}, refraction_of(total)).corona_share, 1.0);
}

TEST_F(Eclipse, CoronaEndsWithoutAnEdge) {
    const Scene total = solar_eclipse(0.0);
    const Picture picture = towards(total, total.sun.direction_enu, 3.2);
    const double sun_px = std::tan(total.sun.angular_radius_rad) / std::tan(3.2 * kDegree) * kSize / 2;
    int largest = 0;
    for (int x = 100 + static_cast<int>(3.0 * sun_px); x + 1 < kSize; ++x) {
        largest = std::max(largest, difference(picture.at(x, 100), picture.at(x + 1, 100)));
        largest =
            std::max(largest, difference(picture.at(x, 199 - (x - 100)), picture.at(x + 1, 198 - (x - 100))));
    }
    std::printf("largest step outwards from 3 radii: %d codes\n", largest);
    EXPECT_LE(largest, 8);
}

TEST(SolarEclipse, SkyOfTotalityIsTwilightNotNight) {
    LightTables tables;
    const double day = luminance(step(tables, solar_eclipse(1.0)), 80, 0);
    const double total = luminance(step(tables, solar_eclipse(0.0)), 80, 0);
    std::printf("zenith: %.3g by day, %.3g cd/m2 in totality\n", day, total);
    EXPECT_GT(total / day, 1e-4);
    EXPECT_LT(total / day, 1e-3);
}

}  // namespace
}  // namespace skyig::render
