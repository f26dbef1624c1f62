#include "server/world/region_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <GeographicLib/Geodesic.hpp>
#include <numbers>

namespace skyig::server::world {
namespace {

using protocol::cigi::EnvRegionControl;

EnvRegionControl region(double latitude_deg, double longitude_deg, float size_x_m, float size_y_m) {
    EnvRegionControl control;
    control.latitude = latitude_deg;
    control.longitude = longitude_deg;
    control.size_x = size_x_m;
    control.size_y = size_y_m;
    return control;
}

/// The weight at a point so far from the centre in that direction.
double weight_at(const EnvRegionControl& control, double azimuth_deg, double distance_m) {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    GeographicLib::Geodesic::WGS84().Direct(control.latitude, control.longitude, azimuth_deg, distance_m,
                                            latitude_deg, longitude_deg);
    return region_weight(control, GroundPoint(latitude_deg, longitude_deg));
}

TEST(RegionWeight, FallsLinearlyAcrossThePerimeterOnEachSide) {
    EnvRegionControl control = region(47.0, 8.0, 20'000.0F, 10'000.0F);
    control.transition_perimeter = 4'000.0F;
    EXPECT_EQ(region_weight(control, GroundPoint(47.0, 8.0)), 1.0);
    // X is north, Y is east; sizes are full lengths.
    EXPECT_EQ(weight_at(control, 0.0, 9'999.0), 1.0);
    EXPECT_NEAR(weight_at(control, 0.0, 12'000.0), 0.5, 1e-6);
    EXPECT_NEAR(weight_at(control, 90.0, 6'000.0), 0.75, 1e-6);
    EXPECT_NEAR(weight_at(control, 180.0, 13'000.0), 0.25, 1e-6);
    EXPECT_NEAR(weight_at(control, 270.0, 8'000.0), 0.25, 1e-6);
    EXPECT_EQ(weight_at(control, 90.0, 9'001.0), 0.0);
}

TEST(RegionWeight, WithoutPerimeterEndsAtTheEdge) {
    const EnvRegionControl control = region(-33.0, 151.0, 2'000.0F, 2'000.0F);
    EXPECT_EQ(weight_at(control, 90.0, 999.99), 1.0);
    EXPECT_EQ(weight_at(control, 90.0, 1'000.01), 0.0);
}

TEST(RegionWeight, RoundsItsCorners) {
    EnvRegionControl control = region(0.0, 0.0, 10'000.0F, 10'000.0F);
    const double corner_m = std::numbers::sqrt2 * 5'000.0;
    EXPECT_EQ(weight_at(control, 45.0, corner_m - 1.0), 1.0);
    control.corner_radius = 2'000.0F;
    // The round corner's edge lies at sqrt(2) * 3000 + 2000 on the diagonal.
    const double round_m = std::numbers::sqrt2 * 3'000.0 + 2'000.0;
    EXPECT_EQ(weight_at(control, 45.0, round_m - 1.0), 1.0);
    EXPECT_EQ(weight_at(control, 45.0, round_m + 1.0), 0.0);
    control.transition_perimeter = 1'000.0F;
    EXPECT_NEAR(weight_at(control, 45.0, round_m + 500.0), 0.5, 1e-6);
    // A circle is one in every direction.
    control.corner_radius = 5'000.0F;
    for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 17.0)
        EXPECT_NEAR(weight_at(control, azimuth_deg, 5'250.0), 0.75, 1e-6) << azimuth_deg;
}

TEST(RegionWeight, SharpCornersHaveARoundPerimeter) {
    EnvRegionControl control = region(10.0, 20.0, 10'000.0F, 10'000.0F);
    control.transition_perimeter = 1'000.0F;
    const double corner_m = std::numbers::sqrt2 * 5'000.0;
    EXPECT_NEAR(weight_at(control, 135.0, corner_m + 500.0), 0.5, 1e-3);
}

TEST(RegionWeight, TurnsClockwiseFromNorth) {
    EnvRegionControl control = region(60.0, 25.0, 20'000.0F, 2'000.0F);
    control.rotation = 30.0F;
    EXPECT_EQ(weight_at(control, 30.0, 9'900.0), 1.0);
    EXPECT_EQ(weight_at(control, 210.0, 9'900.0), 1.0);
    EXPECT_EQ(weight_at(control, 0.0, 9'900.0), 0.0);
    EXPECT_EQ(weight_at(control, -30.0, 9'900.0), 0.0);
}

TEST(RegionWeight, HoldsPolesAndTheAntimeridian) {
    EnvRegionControl pole = region(90.0, 0.0, 200'000.0F, 200'000.0F);
    pole.corner_radius = 100'000.0F;
    pole.transition_perimeter = 100'000.0F;
    for (const double longitude_deg : {-180.0, -90.0, 0.0, 45.0, 179.9, 180.0}) {
        EXPECT_EQ(region_weight(pole, GroundPoint(89.5, longitude_deg)), 1.0) << longitude_deg;
        // 150 km from the pole, on the meridian of 111.694 km a degree
        EXPECT_NEAR(region_weight(pole, GroundPoint(90.0 - 150.0 / 111.694, longitude_deg)), 0.5, 1e-4)
            << longitude_deg;
    }
    EXPECT_EQ(region_weight(pole, GroundPoint(90.0, 77.0)), 1.0);
    pole.latitude = -90.0;
    EXPECT_EQ(region_weight(pole, GroundPoint(-90.0, -12.0)), 1.0);
    EXPECT_EQ(region_weight(pole, GroundPoint(90.0, -12.0)), 0.0);

    EnvRegionControl fiji = region(-17.0, 179.9, 100'000.0F, 100'000.0F);
    EXPECT_EQ(region_weight(fiji, GroundPoint(-17.0, -179.9)), 1.0);
    EXPECT_EQ(region_weight(fiji, GroundPoint(-17.0, 180.0)), 1.0);
    EXPECT_EQ(region_weight(fiji, GroundPoint(-17.0, -179.0)), 0.0);
    EXPECT_EQ(region_weight(fiji, GroundPoint(-17.0, 0.0)), 0.0);
}

TEST(RegionWeight, TakesHugeSizes) {
    EnvRegionControl all = region(0.0, 0.0, 3.0e38F, 3.0e38F);
    all.transition_perimeter = 3.0e38F;
    EXPECT_EQ(region_weight(all, GroundPoint(0.0, 180.0)), 1.0);
    EXPECT_EQ(region_weight(all, GroundPoint(-90.0, 0.0)), 1.0);
}

}  // namespace
}  // namespace skyig::server::world
