#include "clients/skyig/ephem/body_place.h"

#include <glm/glm.hpp>
#include <numbers>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/light.h"
#include "server/ephemeris/magnitude.h"
#include "server/ephemeris/moon_face.h"
#include "server/ephemeris/slow_sky.h"

namespace skyig::clients::ephem {

using namespace server::ephemeris;

namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kArcsecPerRad = 3600.0 * kDegPerRad;

double in_circle_deg(double angle_rad) noexcept {
    const double angle_deg = angle_rad * kDegPerRad;
    return angle_deg < 0.0 ? angle_deg + 360.0 : angle_deg;
}

clients::ephem::MoonFace face_of(const SkyState& state) noexcept {
    const glm::dvec3 pole_of_date_gcrs = glm::transpose(state.true_of_date_from_gcrs)[2];
    const server::ephemeris::MoonFace face =
        moon_face({.direction = state.moon.direction_enu,
                   .to_sun = state.moon.to_sun_enu,
                   .axes_from_selenographic = state.moon.enu_from_selenographic,
                   .pole_of_date = state.enu_from_gcrs * pole_of_date_gcrs,
                   .pole_j2000 = state.enu_from_gcrs[2]});
    return {.subearth_longitude_deg = face.subearth_longitude_rad * kDegPerRad,
            .subearth_latitude_deg = face.subearth_latitude_rad * kDegPerRad,
            .subsolar_longitude_deg = face.subsolar_longitude_rad * kDegPerRad,
            .subsolar_latitude_deg = face.subsolar_latitude_rad * kDegPerRad,
            .axis_position_angle_deg = in_circle_deg(face.axis_j2000_rad)};
}

glm::dvec3 describe_sun(BodyPlace& place, const SunState& sun) noexcept {
    place.range_km = sun.distance_au * kKmPerAu;
    place.semidiameter_arcsec = sun.angular_radius_rad * kArcsecPerRad;
    place.magnitude = sun_magnitude(sun.distance_au);
    return sun.direction_enu;
}

/// Moon and planets tell the same things of themselves.
template <typename State>
glm::dvec3 describe(BodyPlace& place, const State& state) noexcept {
    place.range_km = state.distance_km;
    place.semidiameter_arcsec = state.angular_radius_rad * kArcsecPerRad;
    place.phase_angle_deg = state.phase_angle_rad * kDegPerRad;
    place.illuminated_fraction = state.lit_fraction;
    place.bright_limb_deg = in_circle_deg(state.bright_limb_rad);
    place.magnitude = state.magnitude;
    return state.direction_enu;
}

glm::dvec3 describe_body(BodyPlace& place, const SkyState& state) noexcept {
    if (place.body == Body::kSun) return describe_sun(place, state.sun);
    if (place.body == Body::kMoon) {
        place.moon_face = face_of(state);
        return describe(place, state.moon);
    }
    return describe(place, state.planets[index_of(place.body) - index_of(Body::kMercury)]);
}

}  // namespace

BodyPlace place_in(const SkyState& state, Body body, bool from_site) noexcept {
    BodyPlace place;
    place.body = body;
    const glm::dvec3 direction = describe_body(place, state);
    const Equatorial equatorial =
        equatorial_of(state.true_of_date_from_gcrs * (glm::transpose(state.enu_from_gcrs) * direction));
    place.right_ascension_deg = equatorial.right_ascension_rad * kDegPerRad;
    place.declination_deg = equatorial.declination_rad * kDegPerRad;
    if (from_site) {
        const Horizontal horizontal = horizontal_of(direction);
        place.horizontal = {horizontal.azimuth_rad * kDegPerRad, horizontal.elevation_rad * kDegPerRad};
    }
    return place;
}

SkyState sky_of(const Instant& instant, const std::optional<Geodetic>& site, Model model) noexcept {
    if (site) return compute_sky_state(instant, *site, model);
    return geocentric_state_from(evaluate_slow_sky(instant.tt, model), instant.tt);
}

}  // namespace skyig::clients::ephem
