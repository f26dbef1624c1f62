// Land in the rain: darker where one looks down on it, with the sky in it where one looks along it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "render/sky_frame.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using namespace tests;

class WetGround : public ::testing::Test {
  protected:
    static Scene scene_of(double wet) {
        Scene scene = make_scene(40.0, 180.0, -30.0, 0.0, 30.0);
        scene.air.visibility_m = 50e3;
        scene.ground.wet = wet;
        return scene;
    }
    static double luminance(const Scene& scene, double elevation_deg, double azimuth_deg) {
        SkyFrame frame({}, {});
        frame.prepare(scene, 1e-3);
        return static_cast<double>(shaders32::luminance_709(
            frame.light().rgb_cd_m2(elevation_deg * kDegree, azimuth_deg * kDegree, Side::kByElevation)));
    }
};

TEST_F(WetGround, IsHalfAsBrightFromAboveAndMirrorsTheSkyAlongIt) {
    const double down = luminance(scene_of(1.0), -89.0, 0.0) / luminance(scene_of(0.0), -89.0, 0.0);
    const double along = luminance(scene_of(1.0), -3.0, 0.0) / luminance(scene_of(0.0), -3.0, 0.0);
    std::printf("wet by dry: straight down %.3f, 3 deg below the horizon %.3f\n", down, along);
    // Angstrom's film over an albedo of about 0.1 leaves 0.52 of it; the film's own 2 % of the zenith, of
    // half of the ground, comes on top.
    EXPECT_GT(down, 0.5);
    EXPECT_LT(down, 0.65);
    EXPECT_GT(along, 1.1);
}

TEST_F(WetGround, ComesWithoutAStepAndIgnoresNonsense) {
    double before = luminance(scene_of(0.0), -20.0, 30.0);
    const double dry = before;
    for (const double wet : {0.25, 0.5, 0.75, 1.0}) {
        const double now = luminance(scene_of(wet), -20.0, 30.0);
        EXPECT_LT(now, before);
        EXPECT_GT(now, 0.8 * before);
        before = now;
    }
    EXPECT_EQ(luminance(scene_of(std::numeric_limits<double>::quiet_NaN()), -20.0, 30.0), dry);
    EXPECT_EQ(luminance(scene_of(2.0), -20.0, 30.0), luminance(scene_of(1.0), -20.0, 30.0));
    // Under whole snow no water is seen.
    Scene snow = scene_of(0.0);
    snow.ground.snow = 1.0;
    Scene both = scene_of(1.0);
    both.ground.snow = 1.0;
    EXPECT_EQ(luminance(both, -20.0, 30.0), luminance(snow, -20.0, 30.0));
}

TEST_F(WetGround, OfTheSeaIsTheSea) {
    Scene sea = scene_of(0.0);
    sea.ground.kind = Ground::Kind::kSea;
    Scene wet = scene_of(1.0);
    wet.ground.kind = Ground::Kind::kSea;
    EXPECT_EQ(luminance(sea, -20.0, 30.0), luminance(wet, -20.0, 30.0));
}

// What is drawn follows the film in its frame, and the soil's darkness when its air is made.
TEST_F(WetGround, IsShownByTheDome) {
    SkyFrame frame({}, {});
    Scene scene = scene_of(0.0);
    frame.prepare(scene, 1e-3);
    scene.ground.wet = 1.0;
    for (int i = 0; i < 200; ++i) {
        scene.time_s += 1.0 / 30.0;
        frame.prepare(scene, 1e-3);
    }
    const glm::vec3 wanted = frame.light().smooth_rgb_cd_m2(-0.5 * M_PI, 0.0, Side::kGround);
    EXPECT_NEAR(frame.dome().light().front().y, wanted.y, 1e-3F * wanted.y);
    EXPECT_LT(static_cast<double>(shaders32::luminance_709(wanted)),
              0.7 * luminance(scene_of(0.0), -90.0, 0.0));
}

}  // namespace
}  // namespace skyig::render
