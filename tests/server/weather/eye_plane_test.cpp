#include "server/weather/eye_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <GeographicLib/Geodesic.hpp>
#include <numbers>

#include "render/weather_area.h"

namespace skyig::server::weather {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;

struct There {
    ephemeris::Geodetic place;
    double azimuth_deg = 0.0;
};

There direct(const ephemeris::Geodetic& from, double azimuth_deg, double distance_m) {
    There there;
    GeographicLib::Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, azimuth_deg, distance_m,
                                            there.place.latitude_deg, there.place.longitude_deg,
                                            there.azimuth_deg);
    return there;
}

double worst_error_m(double distance_m) {
    double worst = 0.0;
    for (const double latitude : {-89.9, -60.0, 0.0, 47.4582, 89.99}) {
        const ephemeris::Geodetic eye{latitude, 179.99, 0.0};
        const EyePlane plane(render::Eye{latitude, 179.99, 3000.0});
        for (double azimuth = 5.0; azimuth < 360.0; azimuth += 35.0) {
            GroundArea area;
            area.centre = direct(eye, azimuth, distance_m).place;
            const glm::dvec2 truth =
                distance_m * glm::dvec2{std::sin(azimuth * kRad), std::cos(azimuth * kRad)};
            worst = std::max(worst, glm::distance(plane.place(area).centre_m, truth));
        }
    }
    return worst;
}

TEST(EyePlane, AreasStandWhereTheGeodesicGoes) {
    const double near_m = worst_error_m(40e3), far_m = worst_error_m(300e3);
    std::printf("  worst of all azimuths and latitudes: %.3f m at 40 km, %.3f m at 300 km\n", near_m, far_m);
    EXPECT_LT(near_m, 1.0);
    EXPECT_LT(far_m, 3.0);
}

TEST(EyePlane, AnAreasAxisTurnsWithTheMeridians) {
    for (const double latitude : {-75.0, 0.0, 60.0, 89.0}) {
        const ephemeris::Geodetic eye{latitude, -30.0, 0.0};
        const EyePlane plane(render::Eye{latitude, -30.0, 0.0});
        GroundArea area;
        area.centre = direct(eye, 70.0, 40e3).place;
        area.rotation_rad = 25.0 * kRad;
        const render::WeatherArea placed = plane.place(area);
        // 2 km further along the x axis, on the ground.
        GroundArea further;
        further.centre = direct(area.centre, 25.0, 2000.0).place;
        const glm::dvec2 way = plane.place(further).centre_m - placed.centre_m;
        EXPECT_NEAR(way.x, 2000.0 * std::sin(placed.axis_rad), 0.3) << latitude;
        EXPECT_NEAR(way.y, 2000.0 * std::cos(placed.axis_rad), 0.3) << latitude;
    }
}

TEST(EyePlane, AnAreaUnderTheEyeKeepsItsAxis) {
    GroundArea area;
    area.centre = {47.0, 8.0, 0.0};
    area.rotation_rad = 0.7;
    const render::WeatherArea placed = EyePlane(render::Eye{47.0, 8.0, 5000.0}).place(area);
    EXPECT_EQ(placed.centre_m, glm::dvec2(0.0));
    EXPECT_NEAR(placed.axis_rad, 0.7, 1e-12);
    // At a pole the meridian of the eye is north.
    area.centre = {90.0, 90.0, 0.0};
    EXPECT_NEAR(EyePlane(render::Eye{90.0, 0.0, 0.0}).place(area).axis_rad, 0.7 - 90.0 * kRad, 1e-9);
}

TEST(WeatherArea, ARoundedRectangleFadesOverItsPerimeter) {
    render::WeatherArea area;
    area.centre_m = {1000.0, 0.0};
    area.axis_rad = 90.0 * kRad;  // x to the east
    area.half_size_m = {400.0, 100.0};
    area.corner_radius_m = 50.0;
    area.perimeter_m = 200.0;
    EXPECT_EQ(render::area_weight(area, {1449.0, 0.0}), 1.0);
    EXPECT_EQ(render::area_weight(area, {1000.0, 149.0}), 1.0);
    EXPECT_NEAR(render::area_weight(area, {1550.0, 0.0}), 0.5, 1e-12);
    EXPECT_EQ(render::area_weight(area, {1651.0, 0.0}), 0.0);
    // Round the corner: 30 and 40 beyond it.
    EXPECT_NEAR(render::area_distance_m(area, {1430.0, 140.0}), 0.0, 1e-9);
    EXPECT_NEAR(render::area_distance_m(area, {1000.0, 0.0}), -150.0, 1e-9);
}

}  // namespace
}  // namespace skyig::server::weather
