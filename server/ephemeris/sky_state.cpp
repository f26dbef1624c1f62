#include "server/ephemeris/sky_state.h"

#include <erfam.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/ephemeris/light.h"
#include "server/ephemeris/magnitude.h"
#include "server/ephemeris/rotations.h"
#include "server/ephemeris/site.h"
#include "server/ephemeris/slow_sky.h"

namespace skyig::server::ephemeris {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
/// Turns of the Earth a day of UT1, beyond one (IAU 2000).
constexpr double kSiderealGain = 0.00273781191135448;
constexpr double kEarthRate_rad_s = kTurn_rad * (1.0 + kSiderealGain) / 86400.0;

Geodetic accepted(const Geodetic& eye) noexcept {
    const auto finite = [](double value) { return std::isfinite(value) ? value : 0.0; };
    return {.latitude_deg = std::clamp(finite(eye.latitude_deg), -90.0, 90.0),
            .longitude_deg = finite(eye.longitude_deg),
            .height_m = std::clamp(finite(eye.height_m), kMinEyeHeight_m, kMaxEyeHeight_m)};
}

/// Earth rotation angle (IAU 2000), within a turn or so; whole days turn the Earth by whole turns and the
/// gain.
double earth_rotation_rad(const JulianDate& ut1) noexcept {
    const double days = (ut1.day - ERFA_DJ00) + ut1.fraction;
    const double day_part = ut1.day - std::floor(ut1.day);
    const double turns = 0.7790572732640 + kSiderealGain * days;
    return kTurn_rad * (day_part + ut1.fraction + (turns - std::floor(turns)));
}

/// Polar motion, angles under 1e-4 rad: from the axes that turn about the pole of date to the Earth's own.
glm::dmat3 itrs_from_tirs(double polar_x_rad, double polar_y_rad) noexcept {
    return {1.0, 0.0, -polar_x_rad, 0.0, 1.0, polar_y_rad, polar_x_rad, -polar_y_rad, 1.0};
}

/// asin of radius over range, with sense also for an eye inside the body.
double angular_radius(double radius_km, double range_km) noexcept {
    return std::asin(std::min(radius_km / range_km, 1.0));
}

/// Who looks, GCRS axes, and the axes that directions are wanted in.
struct Observer {
    glm::dvec3 position_km{0.0};
    glm::dvec3 velocity_c{0.0};
    Aberration aberration{velocity_c};
    glm::dmat3 axes_from_gcrs{1.0};
    /// Celestial pole of date in the wanted axes.
    glm::dvec3 pole{0.0, 0.0, 1.0};
};

void place_sun(SunState& sun, const glm::dvec3& path_km, const Observer& observer) noexcept {
    const double range_km = glm::length(path_km);
    sun.direction_enu = observer.axes_from_gcrs * observer.aberration.apparent(path_km / range_km);
    sun.distance_au = range_km / kKmPerAu;
    sun.angular_radius_rad = angular_radius(kBodyRadii_km[index_of(Body::kSun)], range_km);
}

/// Light falls on the Moon along the true direction, and the face that is seen is the one that is turned to
/// the eye. Aberration turns the whole picture, so light, face and shadow turn with the Moon's apparent place
/// and the phase stays the true one.
void place_moon(MoonState& moon, const SlowSky& slow, const glm::dvec3& sun_path_km,
                const Observer& observer) noexcept {
    const glm::dvec3 path_km = light_path(slow.moon_km, slow.moon_velocity_km_s, observer.position_km);
    const double range_km = glm::length(path_km);
    const glm::dvec3 direction = path_km / range_km;
    const glm::dvec3 apparent = observer.aberration.apparent(direction);
    const glm::dvec3 turn = glm::cross(direction, apparent);
    const auto turned = [&turn](const glm::dvec3& v) { return v + glm::cross(turn, v); };
    const glm::dvec3 sun_from_moon_km = sun_path_km - path_km;
    const double sun_range_km = glm::length(sun_from_moon_km);

    moon.direction_enu = observer.axes_from_gcrs * apparent;
    moon.distance_km = range_km;
    moon.angular_radius_rad = angular_radius(kBodyRadii_km[index_of(Body::kMoon)], range_km);
    moon.to_sun_enu = glm::normalize(observer.axes_from_gcrs * turned(sun_from_moon_km));
    moon.phase_angle_rad = angle_between_rad(-moon.direction_enu, moon.to_sun_enu);
    moon.lit_fraction = 0.5 * (1.0 - glm::dot(moon.direction_enu, moon.to_sun_enu));
    moon.bright_limb_rad = position_angle_rad(moon.direction_enu, moon.to_sun_enu, observer.pole);
    moon.magnitude = moon_magnitude(sun_range_km / kKmPerAu, range_km / kKmPerAu, moon.phase_angle_rad);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        moon.enu_from_selenographic[axis] =
            observer.axes_from_gcrs * turned(slow.gcrs_from_selenographic[axis]);
    moon.shadow_axis_enu = observer.axes_from_gcrs * turned(slow.shadow.axis);
    moon.umbra_radius = slow.shadow.umbra_radius;
    moon.penumbra_radius = slow.shadow.penumbra_radius;
    moon.sunlit = slow.shadow.sunlit;
}

/// Parallax moves a planet and its phase by their exact amounts, its brightness by its distance alone (0.01
/// mag from a hundred thousand kilometres up, nothing from the ground). Light and place turn together as the
/// Moon's do.
PlanetState placed_planet(const SlowPlanet& slow, double radius_km, const Observer& observer) noexcept {
    constexpr double kMagnitudesPerRatio = 2.17147240951626;  // 5 / ln 10
    const glm::dvec3 path_km = slow.path_km - observer.position_km;
    const double range_km = glm::length(path_km);
    const glm::dvec3 direction = path_km / range_km;
    const glm::dvec3 apparent = observer.aberration.apparent(direction);
    const glm::dvec3 to_sun = slow.to_sun + glm::cross(glm::cross(direction, apparent), slow.to_sun);
    const glm::dvec3 to_sun_enu = glm::normalize(observer.axes_from_gcrs * to_sun);
    PlanetState planet;
    planet.direction_enu = observer.axes_from_gcrs * apparent;
    planet.distance_km = range_km;
    // The sine stands for the angle: 1e-9 of it.
    planet.angular_radius_rad = radius_km / range_km;
    planet.phase_angle_rad = angle_between_rad(-planet.direction_enu, to_sun_enu);
    planet.lit_fraction = 0.5 * (1.0 - glm::dot(planet.direction_enu, to_sun_enu));
    planet.bright_limb_rad = position_angle_rad(planet.direction_enu, to_sun_enu, observer.pole);
    const double geocentric_km2 = glm::dot(slow.path_km, slow.path_km);
    planet.magnitude =
        slow.magnitude + 0.5 * kMagnitudesPerRatio * (range_km * range_km / geocentric_km2 - 1.0);
    return planet;
}

double obscured(const SunState& sun, const MoonState& moon) noexcept {
    // More than eight degrees apart they cannot touch: no need to measure.
    if (glm::dot(sun.direction_enu, moon.direction_enu) < 0.99) return 0.0;
    return covered_fraction(sun.angular_radius_rad, moon.angular_radius_rad,
                            angle_between_rad(sun.direction_enu, moon.direction_enu));
}

void place_bodies(SkyState& state, const SlowSky& slow, const Observer& observer) noexcept {
    const glm::dvec3 sun_path_km = light_path(slow.sun_km, slow.sun_velocity_km_s, observer.position_km);
    place_sun(state.sun, sun_path_km, observer);
    place_moon(state.moon, slow, sun_path_km, observer);
    for (std::size_t i = 0; i < kPlanetCount; ++i)
        state.planets[i] =
            placed_planet(slow.planets[i], kBodyRadii_km[index_of(Body::kMercury) + i], observer);
    state.sun.obscured = obscured(state.sun, state.moon);
    state.enu_from_gcrs = observer.axes_from_gcrs;
    state.true_of_date_from_gcrs = slow.true_of_date_from_gcrs;
    state.earth_velocity_c = slow.earth_velocity_km_s / kSpeedOfLight_km_s;
    state.eye_velocity_c = observer.velocity_c;
    state.earth_barycentric_au = slow.earth_barycentric_km / kKmPerAu;
    state.earth_heliocentric_au = -slow.sun_km / kKmPerAu;
}

double years_since_j2000(const JulianDate& tt) noexcept {
    return ((tt.day - ERFA_DJ00) + tt.fraction) / 365.25;
}

}  // namespace

bool is_valid(const Geodetic& eye) noexcept {
    return std::isfinite(eye.longitude_deg) && eye.latitude_deg >= -90.0 && eye.latitude_deg <= 90.0 &&
           eye.height_m >= kMinEyeHeight_m && eye.height_m <= kMaxEyeHeight_m;
}

SkyState sky_state_from(const SlowSky& slow, const Instant& instant, const Geodetic& eye) noexcept {
    const Site site = site_of(accepted(eye));
    // A row vector from the left is turned back by a rotation.
    const glm::dmat3 polar_motion = itrs_from_tirs(instant.polar_x_rad, instant.polar_y_rad);
    const glm::dmat3 enu_from_tirs = site.enu_from_itrs * polar_motion;
    const glm::dvec3 position_tirs_km = site.position_itrs_km * polar_motion;
    const double rotation_rad = earth_rotation_rad(instant.ut1);
    const glm::dmat3 tirs_from_gcrs = rotation_about_z(rotation_rad) * slow.cirs_from_gcrs;
    const glm::dvec3 turning_tirs_km_s =
        kEarthRate_rad_s * glm::dvec3(-position_tirs_km.y, position_tirs_km.x, 0.0);
    const Observer observer{
        .position_km = position_tirs_km * tirs_from_gcrs,
        .velocity_c = (slow.earth_velocity_km_s + turning_tirs_km_s * tirs_from_gcrs) / kSpeedOfLight_km_s,
        .axes_from_gcrs = enu_from_tirs * tirs_from_gcrs,
        .pole = enu_from_tirs[2]};
    SkyState state;
    place_bodies(state, slow, observer);
    state.years_since_j2000 = years_since_j2000(instant.tt);
    state.eye_accepted = is_valid(eye);
    return state;
}

SkyState geocentric_state_from(const SlowSky& slow, const JulianDate& tt) noexcept {
    const Observer observer{.position_km = glm::dvec3(0.0),
                            .velocity_c = slow.earth_velocity_km_s / kSpeedOfLight_km_s,
                            .axes_from_gcrs = slow.true_of_date_from_gcrs,
                            .pole = glm::dvec3(0.0, 0.0, 1.0)};
    SkyState state;
    place_bodies(state, slow, observer);
    state.years_since_j2000 = years_since_j2000(tt);
    return state;
}

SkyState compute_sky_state(const Instant& instant, const Geodetic& eye, Model model) noexcept {
    return sky_state_from(evaluate_slow_sky(instant.tt, model), instant, eye);
}

}  // namespace skyig::server::ephemeris
