// `daycycle`: how far between its tables it is from `single`, and what the Sun's way costs.
#include "render/sky/models/day_cycle.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "render/sky/air_data.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky::models {
namespace {

const AirTables& first_order() {
    static const AirTables tables(air_model({}), Orders::kFirst);
    return tables;
}

double dip_rad(double height_m) {
    return first_order().data().shell.dip_rad(height_m);
}

TEST(DayPath, PlacesAndElevationsAreInverse) {
    for (const double dip : {0.0, 0.35}) {
        for (const double elevation_deg : {89.9, 60.0, 10.0, 0.001, 0.0, -0.001, -5.0, -18.0, -89.0}) {
            const double place = day_path_place(elevation_deg * kDeg, dip);
            EXPECT_NEAR(day_path_elevation_rad(place, dip), elevation_deg * kDeg, 1e-12) << elevation_deg;
            EXPECT_GT(day_path_place((elevation_deg - 0.001) * kDeg, dip), place);
        }
    }
}

// Away from the Sun in deep twilight nothing is left that the eye could tell from the night: 1e-4 of the
// brightest.
void compare(const DayCycle& cycle, const SkyView& exact, Errors& errors) {
    const double horizon = exact.horizon_elevation_rad();
    double brightest = 0.0;
    for (const double above : powers(0.002, 1.4, 1.6))
        brightest = std::max(brightest, static_cast<double>(exact.xyz_above(f32(horizon + above), 0.0F).y));
    for (const double above : powers(0.002, 1.4, 1.6)) {
        for (const double azimuth_deg : {0.0, 20.0, 70.0, 120.0, 180.0}) {
            const float azimuth = f32(azimuth_deg * kDeg);
            const auto add = [&](double made, double wanted) {
                errors.add((made - wanted) / (wanted + 1e-3 * brightest));
            };
            add(cycle.xyz_above(f32(horizon + above), azimuth).y,
                exact.xyz_above(f32(horizon + above), azimuth).y);
            add(cycle.xyz_below(f32(horizon - above), azimuth).y,
                exact.xyz_below(f32(horizon - above), azimuth).y);
        }
    }
}

TEST(DayCycle, MidwayBetweenItsTablesItIsWithinOnePercentOfSingle) {
    DayCycle cycle;
    SkyView exact;
    double worst = 0.0;
    for (const double height_m : {2.0, 10e3, 400e3}) {
        for (const double near_deg : {88.0, 60.0, 40.0, 20.0, 8.0, 3.0, 0.5, -0.5, -2.0, -4.0, -6.0}) {
            const double place = std::floor(day_path_place(near_deg * kDeg, dip_rad(height_m))) + 0.5;
            const double elevation = day_path_elevation_rad(place, dip_rad(height_m));
            cycle.begin({}, first_order(), height_m, elevation);
            while (!cycle.build_rows(1000)) {
            }
            exact.begin(first_order(), height_m, elevation);
            exact.build_all();
            Errors errors;
            compare(cycle, exact, errors);
            std::printf("eye %5.0f m, Sun %6.2f deg: rms %.2f %%, largest %.2f %%\n", height_m,
                        elevation / kDeg, 100.0 * errors.rms(), 100.0 * errors.largest());
            worst = std::max(worst, errors.rms());
            EXPECT_LT(errors.rms(), 0.01) << near_deg;
        }
    }
}

TEST(DayCycle, OnATableItIsSingle) {
    DayCycle cycle;
    SkyView exact;
    const double elevation = day_path_elevation_rad(30.0, dip_rad(500.0));
    cycle.begin({}, first_order(), 500.0, elevation);
    while (!cycle.build_rows(1000)) {
    }
    exact.begin(first_order(), 500.0, elevation);
    exact.build_all();
    for (const double e : steps(-1.5, 1.57, 0.07))
        EXPECT_NEAR(cycle.xyz(f32(e), 0.4F).y / exact.xyz(f32(e), 0.4F).y, 1.0F, 1e-3F) << e;
}

TEST(DayCycle, BuildsOneTableForEachPlaceThatTheSunPasses) {
    DayCycle cycle;
    const double from = day_path_elevation_rad(20.2, dip_rad(500.0));
    const double to = day_path_elevation_rad(25.7, dip_rad(500.0));
    int frames = 0;
    for (double elevation = from; elevation > to; elevation -= 0.002 * kDeg, ++frames) {
        cycle.begin({}, first_order(), 500.0, elevation);
        while (!cycle.build_rows(10)) {
        }
    }
    std::printf("%d frames, %d tables\n", frames, cycle.tables_begun());
    EXPECT_EQ(cycle.tables_begun(), 2 + 5);
    // And back again: the Sun rises.
    cycle.begin({}, first_order(), 500.0, day_path_elevation_rad(24.9, dip_rad(500.0)));
    EXPECT_EQ(cycle.tables_begun(), 2 + 5 + 1);
    // A little higher the tables still serve; much higher they do not.
    cycle.begin({}, first_order(), 501.0, day_path_elevation_rad(24.9, dip_rad(500.0)));
    EXPECT_EQ(cycle.tables_begun(), 8);
    cycle.begin({}, first_order(), 600.0, day_path_elevation_rad(24.9, dip_rad(500.0)));
    EXPECT_EQ(cycle.tables_begun(), 10);
}

TEST(DayCycle, DesaturationTakesColourAndLeavesLuminance) {
    DayCycle cycle;
    cycle.begin({}, first_order(), 500.0, 0.5);
    while (!cycle.build_rows(1000)) {
    }
    const glm::vec3 full = cycle.xyz(1.0F, 2.0F);
    cycle.begin({.desaturation = 1.0}, first_order(), 500.0, 0.5);
    ASSERT_TRUE(cycle.build_rows(1000));
    const glm::vec3 grey = cycle.xyz(1.0F, 2.0F);
    EXPECT_FLOAT_EQ(grey.y, full.y);
    EXPECT_NEAR(grey.x / grey.y, 0.95047F, 1e-5F);
    EXPECT_GT(full.z / full.y, 1.3F);
}

}  // namespace
}  // namespace skyig::render::sky::models
