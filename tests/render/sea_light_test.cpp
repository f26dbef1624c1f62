// Sea and snow in a whole frame's light, and what the dome's mesh costs of the glitter in display codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/dome.h"
#include "render/eye/tone_curve.h"
#include "render/light_tables.h"
#include "tests/render/dome_light.h"
#include "tests/render/light_tables_steps.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using tests::kDegree;

Scene at_sea(Scene scene, double wind_m_s) {
    scene.ground.kind = Ground::Kind::kSea;
    scene.ground.wind_m_s = wind_m_s;
    return scene;
}

TEST(SeaLight, DomeDrawsGlitterWithinACode) {
    struct Case {
        const char* name;
        double sun_deg, height_m, wind_m_s;
    };
    for (const Case& c :
         {Case{"noon", 50.0, 300.0, 5.0}, Case{"calm", 35.0, 300.0, 1.0}, Case{"sunset", 2.0, 300.0, 5.0},
          Case{"high", 30.0, 12e3, 8.0}, Case{"orbit", 40.0, 400e3, 8.0}}) {
        const Scene scene = at_sea(tests::make_scene(c.sun_deg, 185.0, -30.0, 40.0, c.height_m), c.wind_m_s);
        SkyFrame frame({}, {});
        frame.prepare(scene, 8e-4);
        const tests::CodeErrors errors = tests::interpolation_errors(frame, 4000, 1.0);
        const DomeSize& size = frame.dome().size();
        std::printf("sea, %-6s codes: median %.3f, p99 %.3f, largest %.3f; %d + %d rows, %d columns\n",
                    c.name, errors.median, errors.p99, errors.largest, size.sky_rows, size.ground_rows,
                    size.columns);
        EXPECT_LT(errors.p99, 0.5) << c.name;
        EXPECT_LT(errors.largest, 1.5) << c.name;
    }
}

TEST(SeaLight, IsBrighterBelowTheMoonAndDarkWithoutIt) {
    const Scene moonlit = at_sea(tests::make_scene(-40.0, 10.0, 25.0, 180.0, 100.0), 5.0);
    LightTables tables;
    const SkyLight light = tests::step(tables, moonlit);
    const double below_moon = tests::luminance(light, -20.0, 180.0);
    EXPECT_GT(below_moon, 20.0 * tests::luminance(light, -20.0, 90.0));
    LightTables dark_tables;
    const SkyLight dark = tests::step(dark_tables, at_sea(tests::make_scene(-40, 10, -40, 180, 100), 5.0));
    const double sea = tests::luminance(dark, -20.0, 180.0);
    EXPECT_GT(sea, 1e-6);
    EXPECT_LT(sea, 0.2 * tests::luminance(dark, 20.0, 180.0));
}

TEST(SeaLight, EveryLookIsFinite) {
    for (const double height_m : {-10.0, 0.0, 12e3, 400e3}) {
        for (const double sun_deg : {90.0, 0.0, -5.0, -20.0}) {
            LightTables tables;
            const SkyLight light =
                tests::step(tables, at_sea(tests::make_scene(sun_deg, 185, 20, 40, height_m), 0.0));
            for (double e = -90.0; e <= 0.0; e += 7.5)
                for (double a = 0.0; a < 360.0; a += 45.0)
                    ASSERT_TRUE(std::isfinite(tests::luminance(light, e, a))) << height_m << " " << sun_deg;
        }
    }
}

TEST(SeaLight, WindAndGroundMakeOnlyWhatTheyChange) {
    Scene scene = at_sea(tests::make_scene(30, 185, -30, 40, 300), 5.0);
    LightTables tables;
    tests::step(tables, scene);
    scene.ground.wind_m_s = 5.001;
    EXPECT_TRUE(tables.held(scene).sun_sky_model);
    scene.ground.wind_m_s = 8.0;
    EXPECT_FALSE(tables.held(scene).sun_sky_model);
    EXPECT_TRUE(tables.held(scene).air_fresh) << "wind is no matter of the air";
    const double calm = tests::luminance(tests::step(tables, scene), -30.0, 225.0);
    for (int i = 0; i < 12; ++i)
        tests::step(tables, scene);
    EXPECT_TRUE(tables.held(scene).sun_sky_model);
    EXPECT_GT(tests::luminance(tests::step(tables, scene), -30.0, 225.0), calm) << "glitter is wider";
    scene.ground.kind = Ground::Kind::kLand;
    EXPECT_FALSE(tables.held(scene).air_fresh);
    for (std::uint64_t i = 0; i < LightTables::kAirLatencyFrames + 15; ++i)
        tests::step(tables, scene);
    EXPECT_EQ(tests::step(tables, scene).sea, nullptr);
}

TEST(SeaLight, CostOfShadingIsKnown) {
    const Scene land = tests::make_scene(50, 185, -30, 40, 300);
    const auto shade_ms = [](const Scene& scene) {
        LightTables tables;
        const SkyLight light = tests::step(tables, scene);
        const auto tone = eye::tone_parameters({}, 3000.0);
        const double azimuth_rad = light.sun.source.azimuth_rad;
        DomeBend bend;
        bend.measure(light, tone, azimuth_rad, 8e-4);
        Dome dome;
        dome.lay_out(dome_layout(light, 8e-4, 3000.0, 1), bend, {});
        double least = 1e9;
        for (int i = 0; i < 6; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            dome.look_up(light, azimuth_rad, Dome::Change::kAtOnce);
            dome.encode(tone);
            const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
            least = std::min(least, took.count());
        }
        return least;
    };
    const double of_land = shade_ms(land);
    const double of_sea = shade_ms(at_sea(land, 5.0));
    std::printf("shade: land %.2f ms, sea %.2f ms, ratio %.2f\n", of_land, of_sea, of_sea / of_land);
    EXPECT_LT(of_sea, 4.0 * of_land);
}

}  // namespace
}  // namespace skyig::render
