// The eye's place and axes held directly against the library's own and against the ellipsoid's equations.
#include "server/ephemeris/site.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <GeographicLib/Geocentric.hpp>
#include <numbers>
#include <vector>

#include "tests/server/ephemeris/largest.h"

namespace skyig::server::ephemeris {
namespace {

template <typename Check>
void at_every_site(const Check& check) {
    for (const double latitude_deg :
         {-90.0, -89.9999999, -51.5, -1e-300, 0.0, 1e-9, 31.5, 66.56, 89.99, 90.0}) {
        for (const double longitude_deg :
             {-180.0, -179.99, -90.0, -1e-9, 0.0, 35.5, 90.0, 179.99, 180.0, 540.0}) {
            for (const double height_m : {-12e3, -430.0, 0.0, 18288.0, 400e3, 36e6, 1e8})
                check(Geodetic{latitude_deg, longitude_deg, height_m});
        }
    }
}

TEST(Site, HasThePlaceAndTheAxesOfGeographicLib) {
    double worst_m = 0.0;
    double worst_axis = 0.0;
    std::vector<double> m(9);
    at_every_site([&](const Geodetic& eye) {
        glm::dvec3 position_m{0.0};
        GeographicLib::Geocentric::WGS84().Forward(eye.latitude_deg, eye.longitude_deg, eye.height_m,
                                                   position_m.x, position_m.y, position_m.z, m);
        const glm::dmat3 itrs_from_enu(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]);
        const Site site = site_of(eye);
        tests::raise(worst_m, glm::length(1000.0 * site.position_itrs_km - position_m));
        const glm::dmat3 difference = glm::transpose(site.enu_from_itrs) - itrs_from_enu;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            tests::raise(worst_axis, glm::length(difference[axis]));
    });
    std::printf("site: %.1e m and %.1e of an axis from GeographicLib\n", worst_m, worst_axis);
    EXPECT_LE(worst_m, 1e-6);
    EXPECT_LE(worst_axis, 1e-15);
}

TEST(Site, StandsOnTheEllipsoidOfWgs84) {
    // The foot of the vertical lies on the ellipsoid, and the vertical is its normal there.
    constexpr double kMajor_m = 6378137.0;
    constexpr double kMinor_m = kMajor_m * (1.0 - 1.0 / 298.257223563);
    double worst_m = 0.0;
    double worst_normal = 0.0;
    at_every_site([&](const Geodetic& eye) {
        const Site site = site_of(eye);
        const glm::dvec3 up = glm::transpose(site.enu_from_itrs)[2];
        const glm::dvec3 foot_m = 1000.0 * site.position_itrs_km - eye.height_m * up;
        const glm::dvec3 scaled = foot_m / glm::dvec3(kMajor_m, kMajor_m, kMinor_m);
        tests::raise(worst_m, (glm::length(scaled) - 1.0) * kMajor_m);
        const glm::dvec3 normal = glm::normalize(scaled / glm::dvec3(kMajor_m, kMajor_m, kMinor_m));
        tests::raise(worst_normal, glm::length(normal - up));
    });
    std::printf("site: %.1e m from the ellipsoid, vertical %.1e from its normal\n", worst_m, worst_normal);
    EXPECT_LE(worst_m, 1e-6);
    EXPECT_LE(worst_normal, 1e-14);
}

}  // namespace
}  // namespace skyig::server::ephemeris
