// What shines on clouds, held against the tables and the sky that it comes from.
#include "render/light_on_clouds.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "render/colour.h"
#include "tests/render/cloud/lit_tables.h"

namespace skyig::render {
namespace {

using cloud::CloudLight;

glm::dvec3 at_elevation(double degrees) {
    const double rad = glm::radians(degrees);
    return {0.0, std::cos(rad), std::sin(rad)};
}

// A scene's tables at rest, and what they shine on clouds.
class Lit {
  public:
    explicit Lit(const Scene& scene) : scene_(scene), lit_(scene) { shine(); }
    void shine() noexcept { light_clouds(scene_, lit_.plan, lit_.tables, lit_.sky, on_clouds_); }
    [[nodiscard]] const CloudLight& light() const noexcept { return on_clouds_; }
    [[nodiscard]] const SkyLight& sky() const noexcept { return lit_.sky; }
    [[nodiscard]] const sky::AirTables& air() const noexcept { return lit_.tables.air(); }

    /// Irradiance / pi of the upper half of directions at the eye.
    [[nodiscard]] double above_cd_m2() const {
        double sum = 0.0;
        constexpr int kRings = 20;
        constexpr int kAround = 24;
        for (int ring = 0; ring < kRings; ++ring) {
            // Even steps of the squared sine: each ring weighs the same.
            const double sine = std::sqrt((ring + 0.5) / kRings);
            for (int i = 0; i < kAround; ++i)
                sum += static_cast<double>(
                    xyz_from_rec709(lit_.sky.smooth_rgb_cd_m2(std::asin(sine),
                                                              2.0 * std::numbers::pi * (i + 0.5) / kAround,
                                                              Side::kSky))
                        .y);
        }
        return sum / (kRings * kAround);
    }

  private:
    Scene scene_;
    tests::LitTables lit_;
    CloudLight on_clouds_;
};

double luminance(const glm::vec3& rgb) {
    return static_cast<double>(xyz_from_rec709(rgb).y);
}

TEST(LightOnClouds, AtTheGroundTheBeamIsTheTablesAndTheSkyItsOwn) {
    for (const double elevation : {60.0, 20.0, 3.0}) {
        Scene scene;
        scene.sun.direction_enu = at_elevation(elevation);
        const Lit lit(scene);
        const double seen_rad = lit.sky().refraction.apparent_from_true(glm::radians(elevation));
        EXPECT_NEAR(
            luminance(lit.light().beam_lx[CloudLight::kSun][0]) / lit.air().direct_sun_xyz(0.0, seen_rad).y,
            1.0, 0.01);
        const double ground = lit.air().ground_diffuse_xyz(glm::radians(elevation)).y / std::numbers::pi;
        std::printf("sun %g deg: sky %.4g, table %.4g, light above clouds %.4g cd/m2\n", elevation,
                    lit.above_cd_m2(), ground, luminance(lit.light().above_cd_m2[0]));
        EXPECT_NEAR(luminance(lit.light().above_cd_m2[0]) / ground, 1.0, 0.05);
        EXPECT_NEAR(luminance(lit.light().above_cd_m2[0]) / lit.above_cd_m2(), 1.0, 0.1);
    }
}

TEST(LightOnClouds, HigherUpTheSkyIsAboutAsDarkAsItIsSeen) {
    Scene scene;
    scene.sun.direction_enu = at_elevation(40.0);
    scene.eye.height_m = 6000.0;
    const Lit lit(scene);
    const double told = luminance(lit.light().at(6000.0).above_cd_m2);
    std::printf("at 6 km: sky %.4g, light above clouds %.4g cd/m2\n", lit.above_cd_m2(), told);
    EXPECT_NEAR(told / lit.above_cd_m2(), 1.0, 0.35);
}

TEST(LightOnClouds, AfterSunsetHighCloudsAreStillLit) {
    Scene scene;
    scene.sun.direction_enu = at_elevation(-2.0);
    const Lit lit(scene);
    EXPECT_EQ(luminance(lit.light().at(0.0).beam_lx[CloudLight::kSun]), 0.0);
    const glm::vec3 high = lit.light().at(10000.0).beam_lx[CloudLight::kSun];
    EXPECT_GT(luminance(high), 100.0);
    EXPECT_GT(high.x, 2.0F * high.z);
}

TEST(LightOnClouds, ByNightATownLightsThemFromBelow) {
    Scene scene;
    scene.sun.direction_enu = at_elevation(-40.0);
    scene.moon.enabled = false;
    const Lit dark(scene);
    scene.night.cities[0] = {scene.eye.latitude_deg, scene.eye.longitude_deg, 8000.0, 0.0, 5e5};
    scene.night.city_count = 1;
    const Lit town(scene);
    const double without = luminance(dark.light().at(1000.0).below_cd_m2);
    const double with = luminance(town.light().at(1000.0).below_cd_m2);
    std::printf("light from below at night: %.3g without, %.3g cd/m2 with a town of 500 000\n", without,
                with);
    EXPECT_GT(without, 0.0);
    EXPECT_LT(without, 1e-3);
    // A big town's overcast is 0.1 to 1 cd/m2 bright.
    EXPECT_GT(with, 0.05);
    EXPECT_LT(with, 5.0);
}

TEST(LightOnClouds, CostsLittleAndIsTheSameEachTime) {
    Scene scene;
    scene.sun.direction_enu = at_elevation(30.0);
    scene.night.cities[0] = {scene.eye.latitude_deg, scene.eye.longitude_deg, 8000.0, 0.01, 0.0};
    scene.night.city_count = 1;
    Lit lit(scene);
    const CloudLight before = lit.light();
    double best_us = 1e9;
    for (int round = 0; round < 50; ++round) {
        const auto start = std::chrono::steady_clock::now();
        lit.shine();
        best_us = std::min(
            best_us,
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    }
    std::printf("light_clouds: %.1f us\n", best_us);
    RecordProperty("light_clouds_us", std::to_string(best_us));
    EXPECT_EQ(before.above_cd_m2, lit.light().above_cd_m2);
    EXPECT_EQ(before.beam_lx, lit.light().beam_lx);
}

}  // namespace
}  // namespace skyig::render
