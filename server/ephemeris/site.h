// An eye on the turning Earth: where it is, and the axes it sees.
#pragma once

#include <glm/glm.hpp>

#include "server/ephemeris/sky_state.h"

namespace skyig::server::ephemeris {

/// Axes of the ITRS: x to the equator at Greenwich, z to the pole.
struct Site {
    glm::dvec3 position_itrs_km{6378.137, 0.0, 0.0};
    /// At a pole east and north are those of the eye's meridian.
    glm::dmat3 enu_from_itrs{1.0};
};

/// WGS84 through GeographicLib, exact at the poles and at 180 degrees from either side. `eye` has to be
/// is_valid().
[[nodiscard]] Site site_of(const Geodetic& eye) noexcept;

}  // namespace skyig::server::ephemeris
