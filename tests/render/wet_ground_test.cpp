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
    EXPECT_GT(along, 1.05);
}

// Of a level mirror of water, by the angles of Snell's law, straight down by the index alone.
double snells_reflectance(double elevation_deg) {
    if (elevation_deg == 90.0) return std::pow(0.333 / 2.333, 2.0);
    const double in = (90.0 - elevation_deg) * kDegree;
    const double on = std::asin(std::sin(in) / 1.333);
    return 0.5 * (std::pow(std::sin(in - on) / std::sin(in + on), 2.0) +
                  std::pow(std::tan(in - on) / std::tan(in + on), 2.0));
}

// Mean over slopes of variance 0.005 each way, each by the area that it shows.
double rough_reflectance(double elevation_deg) {
    const double up = std::sin(elevation_deg * kDegree);
    const double level = std::cos(elevation_deg * kDegree);
    double sum = 0.0, weight = 0.0;
    for (int i = -60; i <= 60; ++i) {
        for (int k = -60; k <= 60; ++k) {
            const double east = i * 0.005;
            const double north = k * 0.005;
            const double shown = up - level * east;
            if (shown <= 0.0) continue;
            const double part = shown * std::exp(-100.0 * (east * east + north * north));
            const double cosine = shown / std::sqrt(1.0 + east * east + north * north);
            weight += part;
            sum += part * snells_reflectance(std::asin(cosine) / kDegree);
        }
    }
    return sum / weight;
}

TEST_F(WetGround, ItsFilmMirrorsAsFresnelHasIt) {
    const Scene scene = scene_of(1.0);
    SkyFrame frame({}, {});
    frame.prepare(scene, 1e-3);
    SkyLight bare = frame.light();
    bare.film = 0.0;
    for (const double elevation_deg : {90.0, 60.0, 45.0, 30.0, 20.0, 15.0, 10.0, 6.0, 3.0}) {
        const double down_rad = -elevation_deg * kDegree;
        const double film = static_cast<double>(frame.light().rgb_cd_m2(down_rad, 1.0, Side::kGround).y) -
                            static_cast<double>(bare.rgb_cd_m2(down_rad, 1.0, Side::kGround).y);
        const double sine = std::sin(down_rad);
        const double mirrored_rad = std::asin(std::min(std::sqrt(sine * sine + 0.01), 1.0));
        const double sky = static_cast<double>(bare.covered_rgb_cd_m2(mirrored_rad, 1.0, Side::kSky).y);
        const double passed = std::exp(-2.996 / 50e3 * 30.0 / -sine);
        const double measured = film / (0.5 * passed * sky);
        std::printf("%2.0f deg: %.1f cd/m2, reflectance %.4f, Fresnel %.4f, of slopes %.4f\n", elevation_deg,
                    film, measured, snells_reflectance(elevation_deg), rough_reflectance(elevation_deg));
        if (elevation_deg >= 15.0) {
            EXPECT_NEAR(measured / snells_reflectance(elevation_deg), 1.0, 0.02);
        }
        EXPECT_NEAR(measured / rough_reflectance(elevation_deg), 1.0, 0.04);
    }
}

TEST_F(WetGround, SnowSendsBackWhatFallsOnIt) {
    Scene scene = scene_of(0.0);
    scene.ground.snow = 1.0;
    SkyFrame frame({}, {});
    frame.prepare(scene, 1e-3);
    const double elevation_rad = 40.0 * kDegree;
    const glm::dvec3 lux = glm::dvec3{frame.light().sun.scale_xyz} *
                           (std::sin(elevation_rad) * frame.air().direct_sun_xyz(0.0, elevation_rad) +
                            frame.air().ground_diffuse_xyz(elevation_rad));
    const double seen = luminance(scene, -89.0, 0.0);
    // Wiscombe and Warren's clean snow, less a tenth: 0.85 where the eye is most sensitive.
    const double wanted = 0.85 * lux.y / M_PI;
    std::printf("snow under %.0f lx: %.0f cd/m2, albedo 0.85 would be %.0f\n", lux.y, seen, wanted);
    EXPECT_NEAR(seen / wanted, 1.0, 0.02);
    EXPECT_GT(seen, 6.0 * luminance(scene_of(0.0), -89.0, 0.0));
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
