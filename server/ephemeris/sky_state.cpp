#include "server/ephemeris/sky_state.h"

#include <erfa.h>
#include <erfam.h>

#include <algorithm>
#include <cmath>
#include <GeographicLib/Math.hpp>
#include <numbers>

#include "server/ephemeris/slow_sky.h"

namespace skyig::server::ephemeris {
namespace {

constexpr double kSpeedOfLight_km_s = ERFA_CMPS / 1000.0;
constexpr double kKmPerAu = ERFA_DAU / 1000.0;
constexpr double kSunRadius_km = 695700.0;
constexpr double kMoonRadius_km = 1737.4;
constexpr double kEquatorRadius_km = 6378.137;
constexpr double kFlattening = 1.0 / 298.257223563;
/// Rate of the Earth rotation angle (IAU 2000), radians per second of UT1.
constexpr double kEarthRate_rad_s = 2.0 * std::numbers::pi * 1.00273781191135448 / 86400.0;

Geodetic accepted(const Geodetic& eye) noexcept {
    const auto finite = [](double value) { return std::isfinite(value) ? value : 0.0; };
    return {.latitude_deg = std::clamp(finite(eye.latitude_deg), -90.0, 90.0),
            .longitude_deg = finite(eye.longitude_deg),
            .height_m = std::clamp(finite(eye.height_m), kMinEyeHeight_m, kMaxEyeHeight_m)};
}

/// An eye that turns with the Earth: where it is, and the axes it sees.
struct Site {
    glm::dvec3 position_itrs_km{0.0};
    glm::dmat3 enu_from_itrs{1.0};
};

/// Sines and cosines in degrees are exact at the poles and at 180 degrees, from either side.
Site site_of(const Geodetic& eye) noexcept {
    double sin_lat = 0.0;
    double cos_lat = 1.0;
    double sin_lon = 0.0;
    double cos_lon = 1.0;
    GeographicLib::Math::sincosd(eye.latitude_deg, sin_lat, cos_lat);
    GeographicLib::Math::sincosd(eye.longitude_deg, sin_lon, cos_lon);

    constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
    const double normal_km = kEquatorRadius_km / std::sqrt(1.0 - kEccentricity2 * sin_lat * sin_lat);
    const double height_km = eye.height_m / 1000.0;
    const double axis_distance_km = (normal_km + height_km) * cos_lat;
    const double z_km = ((1.0 - kEccentricity2) * normal_km + height_km) * sin_lat;

    const glm::dvec3 east(-sin_lon, cos_lon, 0.0);
    const glm::dvec3 north(-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat);
    const glm::dvec3 up(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
    return {.position_itrs_km = {axis_distance_km * cos_lon, axis_distance_km * sin_lon, z_km},
            .enu_from_itrs = glm::transpose(glm::dmat3(east, north, up))};
}

/// Rotation of the axes about the third one by `angle_rad`.
glm::dmat3 rotation_about_z(double angle_rad) noexcept {
    const double s = std::sin(angle_rad);
    const double c = std::cos(angle_rad);
    return {c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0};
}

/// Where the light of a body comes from: from the eye now to the body when the light left it, geocentric
/// GCRS, km. The second step leaves 4 m of the Moon's 40 km.
glm::dvec3 light_path(const glm::dvec3& body_km, const glm::dvec3& velocity_km_s,
                      const glm::dvec3& eye_km) noexcept {
    const glm::dvec3 geometric_km = body_km - eye_km;
    glm::dvec3 path_km = geometric_km;
    for (int step = 0; step < 2; ++step)
        path_km = geometric_km - velocity_km_s * (glm::length(path_km) / kSpeedOfLight_km_s);
    return path_km;
}

/// Lorentz transformation of the direction of light; `velocity_c` is the eye's, barycentric.
glm::dvec3 aberrated(const glm::dvec3& direction, const glm::dvec3& velocity_c) noexcept {
    const double along = glm::dot(direction, velocity_c);
    const double inverse_gamma = std::sqrt(1.0 - glm::dot(velocity_c, velocity_c));
    const double weight = 1.0 + along / (1.0 + inverse_gamma);
    return glm::normalize(direction * inverse_gamma + velocity_c * weight);
}

/// asin of radius over range, with sense also for an eye inside the body.
double angular_radius(double radius_km, double range_km) noexcept {
    return std::asin(std::min(radius_km / range_km, 1.0));
}

/// Unit vector from the Moon to the Sun as the eye should draw it. Light falls on the Moon along the true
/// direction; aberration turns what the eye sees of it, so the light turns with the Moon's apparent place and
/// the phase stays the true one.
glm::dvec3 apparent_sunlight(const glm::dvec3& sun_path_km, const glm::dvec3& moon_path_km,
                             const glm::dvec3& moon_direction, const glm::dvec3& moon_apparent) noexcept {
    const glm::dvec3 to_sun = glm::normalize(sun_path_km - moon_path_km);
    const glm::dvec3 small_rotation = glm::cross(moon_direction, moon_apparent);
    return glm::normalize(to_sun + glm::cross(small_rotation, to_sun));
}

/// Phase and bright limb from the direction to the Moon and its light.
void describe_phase(MoonState& moon, const glm::dvec3& celestial_pole_enu) noexcept {
    moon.phase_angle_rad = angle_between_rad(-moon.direction_enu, moon.to_sun_enu);
    moon.lit_fraction = 0.5 * (1.0 - glm::dot(moon.direction_enu, moon.to_sun_enu));
    const glm::dvec3 east = glm::cross(celestial_pole_enu, moon.direction_enu);
    const glm::dvec3 north = glm::cross(moon.direction_enu, east);
    moon.bright_limb_rad = std::atan2(glm::dot(moon.to_sun_enu, east), glm::dot(moon.to_sun_enu, north));
}

}  // namespace

bool is_valid(const Geodetic& eye) noexcept {
    return std::isfinite(eye.longitude_deg) && eye.latitude_deg >= -90.0 && eye.latitude_deg <= 90.0 &&
           eye.height_m >= kMinEyeHeight_m && eye.height_m <= kMaxEyeHeight_m;
}

double angle_between_rad(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

double covered_fraction(double radius, double covering_radius, double separation) noexcept {
    if (separation >= radius + covering_radius) return 0.0;
    if (separation <= covering_radius - radius) return 1.0;
    if (separation <= radius - covering_radius) {
        const double ratio = covering_radius / radius;
        return ratio * ratio;
    }
    // Two circular segments on the common chord; each is r^2 (a - sin a cos a) with a half the angle of its
    // arc.
    const auto segment = [separation](double r, double other) {
        const double to_chord = (separation * separation + (r - other) * (r + other)) / (2.0 * separation);
        const double half_chord = std::sqrt(std::max((r - to_chord) * (r + to_chord), 0.0));
        return r * r * std::atan2(half_chord, to_chord) - to_chord * half_chord;
    };
    const double lens = segment(radius, covering_radius) + segment(covering_radius, radius);
    return std::clamp(lens / (std::numbers::pi * radius * radius), 0.0, 1.0);
}

SkyState sky_state_from(const SlowSky& slow, const Instant& instant, const Geodetic& eye) noexcept {
    const Site site = site_of(accepted(eye));
    const double rotation_rad = eraEra00(instant.ut1.day, instant.ut1.fraction);
    const glm::dmat3 itrs_from_gcrs = rotation_about_z(rotation_rad) * slow.cirs_from_gcrs;
    const glm::dmat3 gcrs_from_itrs = glm::transpose(itrs_from_gcrs);

    const glm::dvec3 eye_km = gcrs_from_itrs * site.position_itrs_km;
    const glm::dvec3 turning_itrs_km_s =
        kEarthRate_rad_s * glm::dvec3(-site.position_itrs_km.y, site.position_itrs_km.x, 0.0);
    const glm::dvec3 eye_velocity_c =
        (slow.earth_velocity_km_s + gcrs_from_itrs * turning_itrs_km_s) / kSpeedOfLight_km_s;

    SkyState state;
    state.eye_accepted = is_valid(eye);
    state.enu_from_gcrs = site.enu_from_itrs * itrs_from_gcrs;
    state.earth_velocity_c = slow.earth_velocity_km_s / kSpeedOfLight_km_s;
    state.years_since_j2000 = ((instant.tt.day - ERFA_DJ00) + instant.tt.fraction) / 365.25;

    const glm::dvec3 sun_path_km = light_path(slow.sun_km, slow.sun_velocity_km_s, eye_km);
    const double sun_range_km = glm::length(sun_path_km);
    state.sun.direction_enu = state.enu_from_gcrs * aberrated(sun_path_km / sun_range_km, eye_velocity_c);
    state.sun.distance_au = sun_range_km / kKmPerAu;
    state.sun.angular_radius_rad = angular_radius(kSunRadius_km, sun_range_km);

    const glm::dvec3 moon_path_km = light_path(slow.moon_km, slow.moon_velocity_km_s, eye_km);
    const double moon_range_km = glm::length(moon_path_km);
    const glm::dvec3 moon_direction = moon_path_km / moon_range_km;
    const glm::dvec3 moon_apparent = aberrated(moon_direction, eye_velocity_c);
    state.moon.direction_enu = state.enu_from_gcrs * moon_apparent;
    state.moon.distance_km = moon_range_km;
    state.moon.angular_radius_rad = angular_radius(kMoonRadius_km, moon_range_km);
    state.moon.to_sun_enu =
        state.enu_from_gcrs * apparent_sunlight(sun_path_km, moon_path_km, moon_direction, moon_apparent);
    describe_phase(state.moon, site.enu_from_itrs[2]);

    const double separation_rad = angle_between_rad(state.sun.direction_enu, state.moon.direction_enu);
    state.sun.obscured =
        covered_fraction(state.sun.angular_radius_rad, state.moon.angular_radius_rad, separation_rad);
    return state;
}

SkyState compute_sky_state(const Instant& instant, const Geodetic& eye) noexcept {
    return sky_state_from(evaluate_slow_sky(instant.tt), instant, eye);
}

}  // namespace skyig::server::ephemeris
