#include "server/ephemeris/site.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Math.hpp>

namespace skyig::server::ephemeris {

Site site_of(const Geodetic& eye) noexcept {
    glm::dvec3 position_m{0.0};
    GeographicLib::Geocentric::WGS84().Forward(eye.latitude_deg, eye.longitude_deg, eye.height_m,
                                               position_m.x, position_m.y, position_m.z);
    // The library gives axes only into a vector of its own kind, which would have to be allocated.
    double sin_lat = 0.0;
    double cos_lat = 1.0;
    double sin_lon = 0.0;
    double cos_lon = 1.0;
    GeographicLib::Math::sincosd(eye.latitude_deg, sin_lat, cos_lat);
    GeographicLib::Math::sincosd(eye.longitude_deg, sin_lon, cos_lon);
    const glm::dvec3 east(-sin_lon, cos_lon, 0.0);
    const glm::dvec3 north(-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat);
    const glm::dvec3 up(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
    return {.position_itrs_km = position_m / 1000.0,
            .enu_from_itrs = glm::transpose(glm::dmat3(east, north, up))};
}

}  // namespace skyig::server::ephemeris
