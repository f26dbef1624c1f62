#include "clients/skyig/ephem/body_place.h"

#include <numbers>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/places.h"
#include "server/ephemeris/slow_sky.h"

namespace skyig::clients::ephem {

using namespace server::ephemeris;

namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kArcsecPerRad = 3600.0 * kDegPerRad;

clients::ephem::MoonFace face_of(const SkyState& state) noexcept {
    const server::ephemeris::MoonFace face = moon_face(state);
    return {.subearth_longitude_deg = face.subearth_longitude_rad * kDegPerRad,
            .subearth_latitude_deg = face.subearth_latitude_rad * kDegPerRad,
            .subsolar_longitude_deg = face.subsolar_longitude_rad * kDegPerRad,
            .subsolar_latitude_deg = face.subsolar_latitude_rad * kDegPerRad,
            .axis_position_angle_deg = in_circle_deg(face.axis_j2000_rad)};
}

}  // namespace

double in_circle_deg(double angle_rad) noexcept {
    const double angle_deg = turn_from_zero(angle_rad) * kDegPerRad;
    return angle_deg < 360.0 ? angle_deg : 0.0;
}

BodyPlace place_in(const SkyState& state, Body body, bool from_site) noexcept {
    const ApparentPlace seen = apparent_place(state, body);
    const Equatorial equatorial = equatorial_of_date(state, seen.direction);
    BodyPlace place;
    place.body = body;
    place.right_ascension_deg = in_circle_deg(equatorial.right_ascension_rad);
    place.declination_deg = equatorial.declination_rad * kDegPerRad;
    place.range_km = seen.distance_km;
    place.semidiameter_arcsec = seen.angular_radius_rad * kArcsecPerRad;
    place.phase_angle_deg = seen.phase_angle_rad * kDegPerRad;
    place.illuminated_fraction = seen.lit_fraction;
    place.magnitude = seen.magnitude;
    if (body != Body::kSun) place.bright_limb_deg = in_circle_deg(seen.bright_limb_rad);
    if (body == Body::kMoon) place.moon_face = face_of(state);
    if (from_site) {
        const Horizontal horizontal = horizontal_of(seen.direction);
        place.horizontal = {in_circle_deg(horizontal.azimuth_rad), horizontal.elevation_rad * kDegPerRad};
    }
    return place;
}

SkyState sky_of(const Instant& instant, const std::optional<Geodetic>& site, Model model) noexcept {
    if (site) return compute_sky_state(instant, *site, model);
    return geocentric_state_from(evaluate_slow_sky(instant.tt, model), instant.tt);
}

}  // namespace skyig::clients::ephem
