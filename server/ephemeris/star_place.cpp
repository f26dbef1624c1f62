#include "server/ephemeris/star_place.h"

#include "server/ephemeris/light.h"

namespace skyig::server::ephemeris {

glm::dvec3 star_direction(const Star& star, const SkyState& state) noexcept {
    const glm::dvec3 coordinate =
        glm::normalize(star.direction_gcrs + star.proper_motion_rad_yr * state.years_since_j2000 -
                       star.parallax_rad * state.earth_barycentric_au);
    const double sun_distance_au = glm::length(state.earth_heliocentric_au);
    const glm::dvec3 bent =
        deflected(coordinate, coordinate, state.earth_heliocentric_au / sun_distance_au, sun_distance_au);
    return state.enu_from_gcrs * Aberration(state.eye_velocity_c).apparent(bent);
}

}  // namespace skyig::server::ephemeris
