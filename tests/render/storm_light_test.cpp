// What lightning does to the whole picture of a night.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "render/rain_light.h"
#include "render/sky_frame.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using namespace tests;

Scene storm_night() {
    Scene scene = make_scene(-40.0, 0.0, -30.0, 180.0, 400.0);
    scene.air.visibility_m = 10000.0;
    scene.weather.clouds[0].genus = CloudGenus::kCumulonimbus;
    scene.weather.clouds[0].base_m = 1200.0;
    scene.weather.clouds[0].thickness_m = 8000.0;
    scene.weather.cloud_count = 1;
    scene.weather.lightnings[0] = {0, 20.0, 9};
    scene.weather.lightning_count = 1;
    return scene;
}

double luminance(const SkyFrame& frame, const glm::dvec3& direction_enu) {
    const Horizontal at = horizontal_of(direction_enu);
    return static_cast<double>(shaders32::luminance_709(
        frame.light().rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kByElevation)));
}

TEST(StormLight, FlickersOnGroundAndAirAndGoesBackToTheNight) {
    SkyFrame frame({}, {});
    Scene scene = storm_night();
    Scene calm = scene;
    calm.weather.lightning_count = 0;
    frame.prepare(calm, 1e-3);
    const double night_ground = luminance(frame, at(-30.0, 10.0));
    const double night_sky = luminance(frame, at(30.0, 10.0));
    double ground_most = 0.0;
    double sky_most = 0.0;
    int lit = 0;
    int dark = 0;
    for (int i = 0; i < 30 * 60; ++i) {
        scene.time_s += 1.0 / 30.0;
        frame.prepare(scene, 1e-3);
        const double ground = luminance(frame, at(-30.0, 10.0));
        const double sky = luminance(frame, at(30.0, 10.0));
        if (frame.flashes().count == 0) {
            ++dark;
            EXPECT_NEAR(ground, night_ground, 1e-6 * night_ground);
            EXPECT_NEAR(sky, night_sky, 1e-6 * night_sky);
        } else {
            ++lit;
        }
        ground_most = std::max(ground_most, ground);
        sky_most = std::max(sky_most, sky);
    }
    std::printf(
        "night %.2e on the ground, %.2e in the sky; flashes at most %.2e, %.2e cd/m2; lit %d of %d frames\n",
        night_ground, night_sky, ground_most, sky_most, lit, lit + dark);
    EXPECT_GT(ground_most, 10.0 * night_ground);
    EXPECT_GT(sky_most, night_sky);
    EXPECT_GT(lit, 100);
    EXPECT_GT(dark, 300);
}

// Adaptation follows flashes by its own speed, without a step that they do not have.
TEST(StormLight, LeavesADayAlone) {
    SkyFrame frame({}, {});
    Scene scene = storm_night();
    scene.sun.direction_enu = at(40.0, 180.0);
    Scene calm = scene;
    calm.weather.lightning_count = 0;
    frame.prepare(calm, 1e-3);
    const double day = luminance(frame, at(-30.0, 10.0));
    double most = 0.0;
    for (int i = 0; i < 600; ++i) {
        scene.time_s += 1.0 / 30.0;
        frame.prepare(scene, 1e-3);
        most = std::max(most, luminance(frame, at(-30.0, 10.0)) / day - 1.0);
    }
    std::printf("flashes add %.2f %% to a day's ground\n", 100.0 * most);
    EXPECT_LT(most, 0.02);
}

// The dome shows what the light says, in a flash as well.
TEST(StormLight, ReachesTheDomeInItsFrame) {
    SkyFrame frame({}, {});
    Scene scene = storm_night();
    frame.prepare(scene, 1e-3);
    double before = 0.0;
    int followed = 0;
    for (int i = 0; i < 600 && followed < 12; ++i) {
        scene.time_s += 1.0 / 30.0;
        frame.prepare(scene, 1e-3);
        const double now = static_cast<double>(frame.light().flash.ground_lux.y);
        if (now > 1.3 * before && now > 0.005) {
            // The dome's darkest-lit vertex, straight down, is its first.
            const Horizontal down{-0.5 * std::numbers::pi, 0.0};
            const glm::vec3 wanted = frame.light().smooth_rgb_cd_m2(down.elevation_rad, 0.0, Side::kGround);
            EXPECT_NEAR(frame.dome().light().front().y, wanted.y, 1e-3F * wanted.y);
            ++followed;
        }
        before = now;
    }
    EXPECT_GT(followed, 2);
}

// What falls shows the mean of its surroundings, more of it where they are brighter, and never less than
// none.
TEST(StormLight, OfSurroundingsIsTheirMeanAndNeverNegative) {
    SkyFrame frame({}, {});
    for (const double sun_deg : {60.0, 10.0, 1.0, -8.0, -40.0}) {
        Scene scene = make_scene(sun_deg, 120.0, -30.0, 180.0, 400.0);
        scene.air.visibility_m = 5000.0;
        scene.time_s += 1e4;
        frame.prepare(scene, 1e-3);
        const Surroundings around = surroundings(frame.light());
        // Against a fine sum over the sphere.
        double sum = 0.0;
        int count = 0;
        for (double sine = -0.995; sine < 1.0; sine += 0.01) {
            for (double azimuth = 0.0; azimuth < 2.0 * std::numbers::pi; azimuth += 0.05, ++count) {
                sum += static_cast<double>(shaders32::luminance_709(
                    frame.light().smooth_rgb_cd_m2(std::asin(sine), azimuth, Side::kByElevation)));
            }
        }
        const double mean = static_cast<double>(shaders32::luminance_709(around.mean_cd_m2));
        std::printf("sun %5.1f deg: mean %.4g cd/m2, %.1f %% off\n", sun_deg, mean,
                    100.0 * (mean * count / sum - 1.0));
        EXPECT_NEAR(mean * count / sum, 1.0, 0.15);
        for (const auto kind : {Precipitation::Kind::kRain, Precipitation::Kind::kSnow}) {
            const Surroundings shown = shown_by(kind, around);
            for (int k = 0; k < 200; ++k) {
                const double sine = 1.0 - (2.0 * k + 1.0) / 200.0;
                const glm::vec3 view{direction_of({std::asin(sine), 2.4 * k})};
                const float seen = shaders32::luminance_709(shown.mean_cd_m2 + shown.gradient_cd_m2 * view);
                EXPECT_GT(seen, 0.2F * static_cast<float>(mean));
                EXPECT_LT(seen, 2.0F * static_cast<float>(mean));
            }
        }
    }
}

}  // namespace
}  // namespace skyig::render
