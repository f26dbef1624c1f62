#include "server/ephemeris/places.h"

#include "server/ephemeris/light.h"
#include "server/ephemeris/magnitude.h"
#include "server/ephemeris/slow_sky.h"

namespace skyig::server::ephemeris {

ApparentPlace apparent_place(const SkyState& state, Body body) noexcept {
    if (body == Body::kSun) {
        const SunState& sun = state.sun;
        return {.direction = sun.direction_enu,
                .distance_km = sun.distance_au * kKmPerAu,
                .angular_radius_rad = sun.angular_radius_rad,
                .magnitude = sun_magnitude(sun.distance_au)};
    }
    const auto alike = [](const auto& of) {
        return ApparentPlace{.direction = of.direction_enu,
                             .distance_km = of.distance_km,
                             .angular_radius_rad = of.angular_radius_rad,
                             .phase_angle_rad = of.phase_angle_rad,
                             .lit_fraction = of.lit_fraction,
                             .bright_limb_rad = of.bright_limb_rad,
                             .magnitude = of.magnitude};
    };
    if (body == Body::kMoon) return alike(state.moon);
    return alike(state.planets[index_of(body) - index_of(Body::kMercury)]);
}

Equatorial equatorial_of_date(const SkyState& state, const glm::dvec3& direction_enu) noexcept {
    return equatorial_of(state.true_of_date_from_gcrs * (direction_enu * state.enu_from_gcrs));
}

MoonFace moon_face(const SkyState& state) noexcept {
    // The third rows of the matrices are the poles in GCRS.
    const glm::dvec3 pole_of_date_gcrs = glm::transpose(state.true_of_date_from_gcrs)[2];
    return moon_face({.direction = state.moon.direction_enu,
                      .to_sun = state.moon.to_sun_enu,
                      .axes_from_selenographic = state.moon.enu_from_selenographic,
                      .pole_of_date = state.enu_from_gcrs * pole_of_date_gcrs,
                      .pole_j2000 = state.enu_from_gcrs[2]});
}

GeocentricPlaces compute_geocentric(const JulianDate& tt, Model model) noexcept {
    const SkyState state = geocentric_state_from(evaluate_slow_sky(tt, model), tt);
    GeocentricPlaces places;
    for (const Body body : kBodies)
        places.bodies[index_of(body)] = apparent_place(state, body);
    places.moon_face = moon_face(state);
    places.true_of_date_from_gcrs = state.true_of_date_from_gcrs;
    return places;
}

}  // namespace skyig::server::ephemeris
