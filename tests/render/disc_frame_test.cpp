// The shape of a refracted disc, and the ray that stands for a curved one, without GL.
#include "render/disc_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/light_tables_steps.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr double kRadius_rad = 0.00465;
constexpr double kPixel_rad = 1e-4;

SkyLight light_of(const Scene& scene) {
    SkyLight light;
    light.refraction = refraction_of(scene);
    light.horizon_elevation_rad = light.refraction.horizon_elevation_rad();
    light.straight_horizon_rad = horizon_elevation_rad(scene.eye.height_m);
    light.eye_height_m = scene.eye.height_m;
    return light;
}

// Height over width of the outline, from the rows where true offsets reach the radius.
double flattening(const DiscFrame& frame) {
    const auto seen_at = [&](float true_up) {
        for (std::size_t row = 0; row + 1 < DiscFrame::kRows; ++row) {
            const DiscVertex& a = frame.vertices[2 * row];
            const DiscVertex& b = frame.vertices[2 * row + 2];
            if (true_up < a.true_up || true_up > b.true_up) continue;
            return static_cast<double>(
                glm::mix(a.seen.y, b.seen.y, (true_up - a.true_up) / (b.true_up - a.true_up)));
        }
        ADD_FAILURE() << "the rows do not reach over the disc";
        return 0.0;
    };
    return (seen_at(frame.radius) - seen_at(-frame.radius)) / (2.0 * static_cast<double>(frame.radius));
}

TEST(DiscFrame, IsFlattenedAsRefractionFlattens) {
    struct Case {
        double height_m, above_horizon_deg, scale, tolerance;
    };
    for (const Case& c :
         {Case{0.0, 0.27, 0.85, 0.01}, Case{0.0, 5.0, 0.975, 0.01}, Case{0.0, 60.0, 1.0, 1e-3},
          Case{11e3, 0.27, 0.63, 0.03}, Case{400e3, 0.05, 0.2, 0.06}}) {
        Scene scene;
        scene.eye.height_m = c.height_m;
        const SkyLight light = light_of(scene);
        const double seen_rad = light.horizon_elevation_rad + c.above_horizon_deg * kDegree;
        const glm::dvec3 body = direction_of({light.refraction.true_from_apparent(seen_rad), 1.0});
        const double scale = flattening(disc_frame(body, kRadius_rad, kPixel_rad, light));
        std::printf("%6.0f m, %5.2f deg above the horizon: %.3f\n", c.height_m, c.above_horizon_deg, scale);
        EXPECT_NEAR(scale, c.scale, c.tolerance) << c.height_m;
    }
}

TEST(DiscFrame, IsRoundWithoutAirAndCentredOnItsBody) {
    Scene scene;
    scene.air.model_enabled = false;
    const SkyLight light = light_of(scene);
    for (const double elevation : {90.0, 89.9, 45.0, 0.0, -0.2}) {
        const DiscFrame frame = disc_frame(at(elevation, 77.0), kRadius_rad, kPixel_rad, light);
        EXPECT_NEAR(flattening(frame), 1.0, 1e-5) << elevation;
        EXPECT_LT(glm::distance(glm::dvec3{frame.centre_enu}, at(elevation, 77.0)), 1e-7) << elevation;
        EXPECT_NEAR(glm::dot(frame.right_enu, frame.up_enu), 0.0, 1e-6);
        EXPECT_NEAR(glm::dot(frame.centre_enu, frame.up_enu), 0.0, 1e-6);
        EXPECT_NEAR(glm::length(glm::cross(frame.right_enu, frame.up_enu) + frame.centre_enu), 0.0, 1e-6);
    }
}

TEST(DiscFrame, RowsRiseInBothMeasuresForEveryEye) {
    for (const double height_m : {-430.0, 0.0, 11e3, 400e3, 36e6}) {
        Scene scene;
        scene.eye.height_m = height_m;
        const SkyLight light = light_of(scene);
        for (double above = -2.0; above < 2.0; above += 0.05) {
            const double sets_rad = light.refraction.setting_elevation_rad();
            const DiscFrame frame =
                disc_frame(direction_of({sets_rad + above * kDegree, 0.3}), kRadius_rad, kPixel_rad, light);
            for (std::size_t v = 2; v < frame.vertices.size(); ++v) {
                ASSERT_GT(frame.vertices[v].seen.y, frame.vertices[v - 2].seen.y) << height_m << " " << above;
                ASSERT_GT(frame.vertices[v].true_up, frame.vertices[v - 2].true_up)
                    << height_m << " " << above;
                ASSERT_TRUE(std::isfinite(frame.vertices[v].stretch));
            }
        }
    }
}

TEST(SkyLight, StraightRayMeetsTheHorizonAndLeavesLevelZenithAndNadir) {
    for (const double height_m : {0.0, 2.0, 300.0, 11e3, 400e3, 36e6}) {
        Scene scene;
        scene.eye.height_m = height_m;
        const SkyLight light = light_of(scene);
        const double horizon = light.horizon_elevation_rad;
        EXPECT_NEAR(light.straight_elevation_rad(horizon), light.straight_horizon_rad, 1e-12);
        EXPECT_EQ(light.straight_elevation_rad(0.0), 0.0);
        EXPECT_EQ(light.straight_elevation_rad(1.5), 1.5);
        EXPECT_NEAR(light.straight_elevation_rad(-0.5 * std::numbers::pi), -0.5 * std::numbers::pi, 1e-12);
        double last = -2.0;
        for (double e = -90.0; e < 90.0; e += 0.01) {
            const double now = light.straight_elevation_rad(e * kDegree);
            ASSERT_GT(now, last) << height_m << " " << e;
            ASSERT_LT(now - last, last > -2.0 ? 3e-4 : 1.0) << height_m << " " << e;
            last = now;
        }
    }
}

TEST(SkyLight, LowestPointOfTheStraightRayIsThatOfTheCurvedOne) {
    // From 11 km at 1.5 deg down: a ray that keeps n r cos(elevation) against a straight one.
    Scene scene;
    scene.eye.height_m = 11e3;
    const SkyLight light = light_of(scene);
    const sky::StandardAir air;
    double worst_m = 0.0;
    for (double down = 0.3; down < 3.1; down += 0.1) {
        const double invariant =
            (1.0 + air.at(11e3).refractivity) * (kEarthRadius_m + 11e3) * std::cos(down * kDegree);
        double height_m = 11e3;
        for (int i = 0; i < 60; ++i)
            height_m = invariant / (1.0 + air.at(height_m).refractivity) - kEarthRadius_m;
        const double straight = light.straight_elevation_rad(-down * kDegree);
        const double straight_m = (kEarthRadius_m + 11e3) * std::cos(straight) - kEarthRadius_m;
        worst_m = std::max(worst_m, std::abs(straight_m - height_m));
    }
    std::printf("lowest points differ by %.0f m at most\n", worst_m);
    EXPECT_LT(worst_m, 250.0);
}

}  // namespace
}  // namespace skyig::render
