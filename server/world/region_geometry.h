// Where a point of the Earth lies in an environmental region.
#pragma once

#include <glm/glm.hpp>

#include "protocol/cigi/packets.h"

namespace skyig::server::world {

/// A point on the ellipsoid, made once for many regions.
struct GroundPoint {
    /// \param latitude_deg  -90..90  \param longitude_deg  any finite
    GroundPoint(double latitude_deg, double longitude_deg) noexcept;

    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    glm::dvec3 ecef_m{0.0};
};

/// How much of the region's state counts at the point: 1 inside the rounded rectangle, falling linearly with
/// the distance from it to 0 at the transition perimeter's outer edge. Its state (active or not) is the
/// caller's to ask. Region axes are those of the plane in which every point keeps its distance and azimuth
/// along the geodesic from the centre (WGS84), so that a region may hold a pole or the antimeridian; at a
/// pole its north is along the meridian of its longitude.
/// Cost: 0.1 microseconds for a region out of reach, 1 to 2 else.
[[nodiscard]] double region_weight(const protocol::cigi::EnvRegionControl& region,
                                   const GroundPoint& point) noexcept;

}  // namespace skyig::server::world
