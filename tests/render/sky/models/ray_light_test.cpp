// Light along one ray: the tables' own values, and what a finite distance does to it.
#include "render/sky/ray_light.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "render/sky/sky_view.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

const AirTables& scene_air() {
    static const AirTables tables(air_model({}));
    return tables;
}

TEST(RayLight, IsWhatTheTableInterpolates) {
    SkyView view;
    Errors errors;
    for (const double height_m : {2.0, 3000.0, 12e3, 400e3}) {
        for (const double source_deg : {50.0, 5.0, -3.0}) {
            view.begin(scene_air(), height_m, source_deg * kDeg);
            view.build_all();
            for (int row = 1; row < 40; row += 3) {
                RayQuery ray{height_m, source_deg * kDeg, view.sky_row_elevation_rad(row), 90.0 * kDeg};
                const auto seen =
                    static_cast<double>(view.xyz_above(f32(ray.elevation_rad), f32(90.0 * kDeg)).y);
                if (seen > 1e-3) errors.add(ray_light(scene_air(), ray).xyz.y / seen - 1.0);
            }
            for (int row = 1; row < 20; row += 3) {
                RayQuery ray{height_m, source_deg * kDeg, view.ground_row_elevation_rad(row), 90.0 * kDeg};
                const auto seen =
                    static_cast<double>(view.xyz_below(f32(ray.elevation_rad), f32(90.0 * kDeg)).y);
                if (seen > 1e-3) errors.add(ray_light(scene_air(), ray).xyz.y / seen - 1.0);
            }
        }
    }
    std::printf("%zu nodes, largest difference %.1e\n", errors.count(), errors.largest());
    EXPECT_LT(errors.largest(), 2e-3);
}

TEST(RayLight, ContrastAtTheVisibilityIsFivePercent) {
    for (const double visibility_m : {2000.0, 10e3, 40e3}) {
        Air air;
        air.visibility_m = visibility_m;
        const AirTables tables(air_model(air), Orders::kFirst);
        RayQuery ray;
        ray.source_elevation_rad = 0.6;
        ray.distance_m = visibility_m;
        const RayLight seen = ray_light(tables, ray);
        // Between 537 and 558 nm; a level ray rises a little over the round ground.
        const double green = 0.38 * static_cast<double>(seen.transmittance[7]) +
                             0.62 * static_cast<double>(seen.transmittance[8]);
        std::printf("visibility %.0f m: transmittance %.4f\n", visibility_m, green);
        EXPECT_NEAR(green, 0.05, visibility_m > 20e3 ? 0.006 : 0.002);
    }
}

TEST(RayLight, GrowsFromNothingToTheWholeRayAndTransmittancesMultiply) {
    for (const double elevation_deg : {-10.0, -0.5, 0.0, 3.0, 40.0}) {
        RayQuery ray{3000.0, 0.4, elevation_deg * kDeg, 0.7, 0.0};
        const RayLight none = ray_light(scene_air(), ray);
        EXPECT_EQ(none.xyz.y, 0.0);
        EXPECT_EQ(none.transmittance[8], 1.0F);
        EXPECT_FALSE(none.meets_ground);
        double last = 0.0;
        float passed = 1.0F;
        for (const double distance_m : powers(10.0, 3e6, 1.7)) {
            ray.distance_m = distance_m;
            const RayLight part = ray_light(scene_air(), ray);
            EXPECT_GE(part.xyz.y, last * 0.997);
            EXPECT_LE(part.transmittance[8], passed * 1.001F);
            last = part.xyz.y;
            passed = part.transmittance[8];
        }
        ray.distance_m = std::numeric_limits<double>::infinity();
        const RayLight whole = ray_light(scene_air(), ray);
        EXPECT_NEAR(last / whole.xyz.y, 1.0, 0.003) << elevation_deg;
        EXPECT_EQ(whole.meets_ground, elevation_deg < -2.0);
    }
}

TEST(RayLight, HostileNumbersDoNoHarm) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, inf, -inf, 1e300, -1e300}) {
        for (const RayQuery& ray : {RayQuery{bad, 0.1, 0.2, 0.3, 1e4}, RayQuery{10.0, bad, 0.2, 0.3, 1e4},
                                    RayQuery{10.0, 0.1, bad, 0.3, 1e4}, RayQuery{10.0, 0.1, 0.2, bad, 1e4},
                                    RayQuery{10.0, 0.1, 0.2, 0.3, bad}, RayQuery{bad, bad, bad, bad, bad}}) {
            const RayLight light = ray_light(scene_air(), ray);
            EXPECT_TRUE(std::isfinite(light.xyz.x) && std::isfinite(light.xyz.y) &&
                        std::isfinite(light.xyz.z));
            for (const float part : light.transmittance)
                EXPECT_TRUE(part >= 0.0F && part <= 1.0F);
        }
    }
}

TEST(RayLight, WhiteTransmittanceIsWhite) {
    Spectrum half;
    half.fill(0.5F);
    const glm::dvec3 rgb = transmittance_rgb(scene_air().model(), half);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(rgb[i], 0.5, 1e-6);
}

}  // namespace
}  // namespace skyig::render::sky
