#include "render/sky/reference/ray_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace skyig::render::sky::reference {
namespace {

constexpr double kScaleM = 8000.0;

TEST(RayCells, VerticalColumnsAreThoseOfTheExponential) {
    const Medium medium(atmosphere_b_law());
    const Triple up = column_m(medium, 0.0, 1.0, 20);
    const Triple down = column_m(medium, 400e3, -1.0, 20);
    const double molecules = kScaleM * -std::expm1(-60e3 / kScaleM);
    const double aerosol = 1200.0 * -std::expm1(-60e3 / 1200.0);
    const double ozone = 0.5 * 30e3;  // a triangle of height 1
    std::printf("molecules %.3f m of %.3f, aerosol %.4f of %.4f, ozone %.1f of %.1f\n", up.molecules,
                molecules, up.aerosol, aerosol, up.ozone, ozone);
    for (const Triple& column : {up, down}) {
        EXPECT_NEAR(column.molecules / molecules, 1.0, 1e-4);
        EXPECT_NEAR(column.aerosol / aerosol, 1.0, 1e-3);
        EXPECT_NEAR(column.ozone / ozone, 1.0, 0.03);
    }
}

// Horizontally from the ground, far below the lid: sqrt(pi R H / 2) (1 + 3 H / 8 R ...), the Chapman
// function.
TEST(RayCells, HorizontalColumnIsChapmans) {
    AirLaw law = atmosphere_b_law();
    law.shape.top_height_m = 200e3;
    const Medium medium(law);
    const double radius_m = law.shape.ground_radius_m;
    const double chapman =
        std::sqrt(0.5 * std::numbers::pi * radius_m * kScaleM) * (1.0 + 0.375 * kScaleM / radius_m);
    const double ours = column_m(medium, 0.0, 0.0, 20).molecules;
    std::printf("%.1f m of %.1f\n", ours, chapman);
    EXPECT_NEAR(ours / chapman, 1.0, 2e-4);
}

TEST(RayCells, ARayThroughItsLowestPointSeesBothHalvesAlike) {
    const Medium medium(atmosphere_b_law());
    const Shell& shell = medium.shell();
    const double height_m = 9000.0;
    // Tangent at 1 km.
    const double cosine =
        -std::sqrt((height_m - 1000.0) * (2.0 * shell.ground_radius_m + height_m + 1000.0)) /
        (shell.ground_radius_m + height_m);
    const double whole = column_m(medium, height_m, cosine, 40).molecules;
    const double beyond = column_m(medium, height_m, -cosine, 40).molecules;
    const double half = column_m(medium, 1000.0, 0.0, 40).molecules;
    EXPECT_NEAR((whole + beyond) / (2.0 * half), 1.0, 1e-5);
}

TEST(RayCells, RaysThatMissTheAirHaveNoCells) {
    const Medium medium(atmosphere_b_law());
    Cell cell;
    EXPECT_FALSE(RayCells(medium, 400e3, 0.5, 20).next(cell));
    EXPECT_FALSE(RayCells(medium, 400e3, -0.2, 20).next(cell));
    EXPECT_TRUE(RayCells(medium, 400e3, -0.4, 20).meets_ground());
    EXPECT_FALSE(RayCells(medium, 0.0, 0.0, 20).meets_ground());
}

TEST(RayCells, ColumnsInsideACellAreTheIntegralOfItsDensity) {
    const Medium medium(atmosphere_b_law());
    RayCells ray(medium, 0.0, 0.3, 20);
    for (Cell cell; ray.next(cell);) {
        constexpr int kSteps = 200;
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i)
            sum += cell.density(0.7 * (i + 0.5) / kSteps).molecules * 0.7 * cell.length_m / kSteps;
        EXPECT_NEAR(cell.column_m(0.7).molecules / sum, 1.0, 1e-4);
        EXPECT_NEAR(cell.density(0.0).molecules, cell.from.molecules, 1e-12);
        EXPECT_NEAR(cell.density(1.0).molecules, cell.to.molecules, 1e-12);
    }
}

}  // namespace
}  // namespace skyig::render::sky::reference
