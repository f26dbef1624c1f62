#include "server/world/region_geometry.h"

#include <algorithm>
#include <cmath>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>

#include "server/world/pose.h"

namespace skyig::server::world {

GroundPoint::GroundPoint(double latitude, double longitude) noexcept
    : latitude_deg(latitude), longitude_deg(longitude), ecef_m(ecef_of({latitude, longitude, 0.0})) {}

double region_weight(const protocol::cigi::EnvRegionControl& region, const GroundPoint& point) noexcept {
    const double half_x_m = static_cast<double>(region.size_x) / 2.0;
    const double half_y_m = static_cast<double>(region.size_y) / 2.0;
    const double perimeter_m = static_cast<double>(region.transition_perimeter);
    // No geodesic is shorter than the chord.
    const glm::dvec3 centre_m = ecef_of({region.latitude, region.longitude, 0.0});
    if (glm::distance(centre_m, point.ecef_m) > std::hypot(half_x_m, half_y_m) + perimeter_m) return 0.0;

    double distance_m = 0.0;
    double azimuth_deg = 0.0;
    double azimuth_there_deg = 0.0;
    GeographicLib::Geodesic::WGS84().Inverse(region.latitude, region.longitude, point.latitude_deg,
                                             point.longitude_deg, distance_m, azimuth_deg, azimuth_there_deg);
    double sine = 0.0;
    double cosine = 1.0;
    GeographicLib::Math::sincosd(azimuth_deg - static_cast<double>(region.rotation), sine, cosine);

    // Signed distance from a rectangle whose corners are rounded off.
    const double radius_m = static_cast<double>(region.corner_radius);
    const double beyond_x_m = std::abs(distance_m * cosine) - (half_x_m - radius_m);
    const double beyond_y_m = std::abs(distance_m * sine) - (half_y_m - radius_m);
    const double outside_m = std::hypot(std::max(beyond_x_m, 0.0), std::max(beyond_y_m, 0.0)) +
                             std::min(std::max(beyond_x_m, beyond_y_m), 0.0) - radius_m;
    if (outside_m <= 0.0) return 1.0;
    return outside_m < perimeter_m ? 1.0 - outside_m / perimeter_m : 0.0;
}

}  // namespace skyig::server::world
