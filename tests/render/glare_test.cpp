// The veil round Sun and Moon, without GL.
#include "render/glare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/eye/adaptation.h"
#include "render/eye/tone_curve.h"
#include "tests/render/light_tables_steps.h"

namespace skyig::render {
namespace {

using namespace tests;

struct Frame {
    Frame(const Scene& scene, double adaptation_cd_m2) {
        light = step(tables, scene);
        tone = eye::tone_parameters(display, adaptation_cd_m2);
        sun.update(sun_glare(scene, tables.air(), light), light, display, tone);
        moon.update(moon_glare(scene, tables.air(), light), light, display, tone);
    }
    LightTables tables;
    SkyLight light;
    DisplaySettings display;
    shaders64::ToneParameters tone;
    Glare sun, moon;
};

TEST(Glare, LawHasItsPublishedValuesAndGoesWithTheOldOneOverItsRange) {
    // 10/t^3 + (5/t^2 + 0.05/t) 1.0983 + 0.00125.
    EXPECT_NEAR(veil_per_lux(1.0 * kDegree), 10.0 + 5.05 * 1.0983 + 0.00125, 1e-3);
    EXPECT_NEAR(veil_per_lux(10.0 * kDegree), 0.01 + 0.055 * 1.0983 + 0.00125, 1e-5);
    // Stiles and Holladay, 10/t^2, holds from 1 to 30 deg within a factor of 2.
    for (double deg = 1.5; deg < 30.0; deg += 0.5)
        EXPECT_NEAR(std::log2(veil_per_lux(deg * kDegree) * deg * deg / 10.0), 0.0, 1.0) << deg;
    for (double deg = 0.0; deg < 100.0; deg += 0.1)
        EXPECT_GE(veil_per_lux(deg * kDegree), veil_per_lux((deg + 0.1) * kDegree)) << deg;
}

TEST(Glare, FullMoonHasAHaloByNightThatFadesToNothing) {
    Scene scene = make_scene(-40.0, 0.0, 40.0, 180.0, 0.0);
    scene.moon.phase_angle_rad = 0.05;
    scene.moon.to_sun_enu = -scene.moon.direction_enu;
    const Frame frame(scene, 0.01);
    ASSERT_GT(frame.moon.reach_rad(), 5.0 * kDegree);
    EXPECT_EQ(frame.sun.reach_rad(), 0.0);
    const auto vertices = frame.moon.vertices();
    for (std::size_t s = 0; s < Glare::kSectors; ++s) {
        float last = 1.0F;
        for (std::size_t ring = 0; ring < Glare::kRings; ++ring) {
            const GlareVertex& vertex = vertices[1 + ring * Glare::kSectors + s];
            EXPECT_LE(vertex.over_sky.y, last) << ring << " " << s;
            last = vertex.over_sky.y;
        }
        EXPECT_EQ(last, 0.0F);
    }
    std::printf("limb adds %.0f codes, reach %.1f deg\n",
                static_cast<double>(vertices[1].over_sky.y * 255.0F), frame.moon.reach_rad() / kDegree);
    EXPECT_GT(vertices[1].over_sky.y, 10.0F / 255.0F);
    EXPECT_LT(vertices[1].over_sky.y, 110.0F / 255.0F);
}

TEST(Glare, MoonByDayAndMoonInTheUmbraHaveNone) {
    EXPECT_EQ(Frame(make_scene(35.0, 120.0, 30.0, 210.0, 0.0), 3000.0).moon.reach_rad(), 0.0);
    Scene eclipsed = make_scene(-40.0, 0.0, 40.0, 180.0, 0.0);
    eclipsed.moon.sunlit = 0.0;
    EXPECT_EQ(Frame(eclipsed, 2e-4).moon.reach_rad(), 0.0);
}

TEST(Glare, SunAddsLittleToWhatItsAureoleAlreadyShows) {
    for (const double elevation_deg : {60.0, 25.0, 5.0}) {
        const Frame frame(make_scene(elevation_deg, 180.0, -40.0, 0.0, 0.0), 3000.0);
        if (frame.sun.reach_rad() == 0.0) continue;
        const double ratio = std::pow(frame.sun.reach_rad() / 0.004652, 1.0 / (Glare::kRings - 1));
        const auto ring = static_cast<std::size_t>(std::log(5.0 * kDegree / 0.004652) / std::log(ratio));
        float most = 0.0F;
        for (std::size_t s = 0; s < Glare::kSectors; ++s)
            most = std::max(
                most,
                frame.sun.vertices()[1 + std::min(ring, Glare::kRings - 1) * Glare::kSectors + s].over_sky.y);
        std::printf("sun at %2.0f deg: reach %.1f deg, 5 deg away %.1f codes\n", elevation_deg,
                    frame.sun.reach_rad() / kDegree, static_cast<double>(most * 255.0F));
        EXPECT_LT(most * 255.0F, 20.0F) << elevation_deg;
    }
}

TEST(Glare, FallsWithThePartOfTheDiscThatIsSeen) {
    Scene scene = make_scene(30.0, 180.0, -40.0, 0.0, 0.0);
    LightTables tables;
    const auto lux = [&] {
        const SkyLight light = step(tables, scene);
        return shaders64::luminance_709(sun_glare(scene, tables.air(), light).rgb_lux);
    };
    const double whole = lux();
    scene.sun.unobscured = 0.25;
    EXPECT_NEAR(lux() / whole, 0.25, 1e-6);
    scene.sun.unobscured = 1.0;
    const double setting_rad = refraction_of(scene).setting_elevation_rad();
    double last = 1e9;
    for (double above_deg = 0.6; above_deg > -0.6; above_deg -= 0.1) {
        scene.sun.direction_enu = direction_of({setting_rad + above_deg * kDegree, 3.0});
        const double now = lux();
        EXPECT_LE(now, last) << above_deg;
        last = now;
    }
    EXPECT_EQ(last, 0.0);
    scene.sun.enabled = false;
    EXPECT_EQ(lux(), 0.0);
}

TEST(Glare, CanBeSwitchedOffAndThePlanSaysWhy) {
    Plan plan;
    plan_glare(plan, Pass::kSunGlare, false, 0.1);
    EXPECT_FALSE(plan.needs(Pass::kSunGlare));
    EXPECT_EQ(plan[Pass::kSunGlare].reason, "switched off");
    plan_glare(plan, Pass::kMoonGlare, true, 0.0);
    EXPECT_FALSE(plan.needs(Pass::kMoonGlare));
    plan_glare(plan, Pass::kMoonGlare, true, 0.1);
    EXPECT_TRUE(plan.needs(Pass::kMoonGlare));
    EXPECT_EQ(plan[Pass::kMoonGlare].resolution.rows, static_cast<int>(Glare::kRings));

    Scene scene = make_scene(-40.0, 0.0, 40.0, 180.0, 0.0);
    Frame frame(scene, 0.01);
    frame.display.glare = false;
    frame.moon.update(moon_glare(scene, frame.tables.air(), frame.light), frame.light, frame.display,
                      frame.tone);
    EXPECT_EQ(frame.moon.reach_rad(), 0.0);
}

}  // namespace
}  // namespace skyig::render
