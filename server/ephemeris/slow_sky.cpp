#include "server/ephemeris/slow_sky.h"

#include <cmath>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/earth_frame.h"
#include "server/ephemeris/light.h"
#include "server/ephemeris/magnitude.h"
#include "server/ephemeris/moon_face.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::server::ephemeris {
namespace {

/// Gravity of the Sun, km3/s2 (IAU 2015 nominal value).
constexpr double kSunGravity_km3_s2 = 1.3271244e11;

theory::EarthMotion earth_of(const JulianDate& tt, Model model) noexcept {
    return model == Model::kAlmanac ? theory::earth_almanac(tt) : theory::earth_epv00(tt);
}

theory::PositionVelocity moon_of(const JulianDate& tt, Model model) noexcept {
    switch (model) {
        case Model::kAlmanac:
            return theory::moon_almanac(tt);
        case Model::kErfa:
            return theory::moon_moon98(tt);
        case Model::kSeries:
            break;
    }
    return theory::moon_elpmpp02(tt);
}

theory::PositionVelocity planet_of(Body planet, const JulianDate& tt, Model model) noexcept {
    switch (model) {
        case Model::kAlmanac:
            return theory::planet_elements(planet, tt);
        case Model::kErfa:
            return theory::planet_plan94(planet, tt);
        case Model::kSeries:
            break;
    }
    return theory::planet_vsop87(planet, tt);
}

/// The planet `seconds` ago by its velocity and the Sun's pull; over Mercury's twelve minutes of light time
/// this leaves 0.1 km, over Saturn's ninety nothing.
glm::dvec3 heliocentric_before(const theory::PositionVelocity& now, double seconds) noexcept {
    const double range_km = glm::length(now.position_km);
    const glm::dvec3 pull_km_s2 = now.position_km * (-kSunGravity_km3_s2 / (range_km * range_km * range_km));
    return now.position_km - now.velocity_km_s * seconds + pull_km_s2 * (0.5 * seconds * seconds);
}

/// What the planets have in common at one date.
struct Vantage {
    glm::dvec3 earth_heliocentric_km;
    glm::dvec3 sun_velocity_km_s;
    double centuries;
};

SlowPlanet slow_planet(Body body, const theory::PositionVelocity& now, const Vantage& from) noexcept {
    glm::dvec3 from_sun_km = now.position_km;
    glm::dvec3 path_km = from_sun_km - from.earth_heliocentric_km;
    for (int step = 0; step < 3; ++step) {
        const double light_time_s = glm::length(path_km) / kSpeedOfLight_km_s;
        from_sun_km = heliocentric_before(now, light_time_s);
        path_km = from_sun_km - from.earth_heliocentric_km - from.sun_velocity_km_s * light_time_s;
    }
    const double range_km = glm::length(path_km);
    const double sun_range_km = glm::length(from_sun_km);
    const double earth_range_km = glm::length(from.earth_heliocentric_km);
    const glm::dvec3 direction = path_km / range_km;
    const glm::dvec3 planet_from_sun = from_sun_km / sun_range_km;

    SlowPlanet planet;
    planet.path_km =
        range_km * deflected(direction, planet_from_sun, from.earth_heliocentric_km / earth_range_km,
                             earth_range_km / kKmPerAu);
    const glm::dvec3 bend = glm::cross(direction, planet.path_km / range_km);
    planet.to_sun = -planet_from_sun - glm::cross(bend, planet_from_sun);
    PlanetLight light{.sun_distance_au = sun_range_km / kKmPerAu,
                      .distance_au = range_km / kKmPerAu,
                      .phase_angle_rad = angle_between_rad(direction, planet_from_sun)};
    if (body == Body::kSaturn)
        light.ring_inclination_rad = ring_inclination_rad(-direction, -planet_from_sun, from.centuries);
    planet.magnitude = planet_magnitude(body, light);
    return planet;
}

/// The Moon in the shadow: light that reaches it at the time of its light path passed the Earth a second
/// earlier still, when the Earth stood back.
EarthShadow shadow_of(const SlowSky& slow) noexcept {
    const double light_time_s = glm::length(slow.moon_km) / kSpeedOfLight_km_s;
    const glm::dvec3 moon_then_km =
        slow.moon_km - light_time_s * slow.moon_velocity_km_s + 2.0 * light_time_s * slow.earth_velocity_km_s;
    return earth_shadow(moon_then_km, slow.sun_km + 2.0 * light_time_s * slow.earth_velocity_km_s);
}

}  // namespace

SlowSky evaluate_slow_sky(const JulianDate& tt, Model model) noexcept {
    // TT stands for TDB: they differ by under 2 ms, the Moon by 0.001 arcsec.
    const theory::EarthMotion earth = earth_of(tt, model);
    const theory::PositionVelocity moon = moon_of(tt, model);
    const EarthFrame frame = earth_frame(tt, model);

    SlowSky slow;
    slow.earth_barycentric_km = earth.barycentric.position_km;
    slow.earth_velocity_km_s = earth.barycentric.velocity_km_s;
    slow.sun_km = -earth.heliocentric.position_km;
    slow.sun_velocity_km_s = earth.barycentric.velocity_km_s - earth.heliocentric.velocity_km_s;
    slow.moon_km = moon.position_km;
    slow.moon_velocity_km_s = earth.barycentric.velocity_km_s + moon.velocity_km_s;
    slow.cirs_from_gcrs = frame.cirs_from_gcrs;
    slow.true_of_date_from_gcrs = frame.true_of_date_from_gcrs;
    slow.gcrs_from_selenographic = gcrs_from_selenographic(tt, frame);
    slow.shadow = shadow_of(slow);

    const Vantage vantage{.earth_heliocentric_km = earth.heliocentric.position_km,
                          .sun_velocity_km_s = slow.sun_velocity_km_s,
                          .centuries = ((tt.day - 2451545.0) + tt.fraction) / 36525.0};
    for (std::size_t i = 0; i < kPlanetCount; ++i) {
        const Body body = kBodies[index_of(Body::kMercury) + i];
        slow.planets[i] = slow_planet(body, planet_of(body, tt, model), vantage);
    }
    return slow;
}

SlowSky interpolate(const SlowSky& from, const SlowSky& to, double fraction) noexcept {
    const auto mix = [fraction](const auto& a, const auto& b) { return a + (b - a) * fraction; };
    SlowSky slow{.sun_km = mix(from.sun_km, to.sun_km),
                 .sun_velocity_km_s = mix(from.sun_velocity_km_s, to.sun_velocity_km_s),
                 .moon_km = mix(from.moon_km, to.moon_km),
                 .moon_velocity_km_s = mix(from.moon_velocity_km_s, to.moon_velocity_km_s),
                 .earth_barycentric_km = mix(from.earth_barycentric_km, to.earth_barycentric_km),
                 .earth_velocity_km_s = mix(from.earth_velocity_km_s, to.earth_velocity_km_s),
                 .cirs_from_gcrs = mix(from.cirs_from_gcrs, to.cirs_from_gcrs),
                 .true_of_date_from_gcrs = mix(from.true_of_date_from_gcrs, to.true_of_date_from_gcrs),
                 .gcrs_from_selenographic = mix(from.gcrs_from_selenographic, to.gcrs_from_selenographic),
                 .shadow = {.axis = mix(from.shadow.axis, to.shadow.axis),
                            .umbra_radius = mix(from.shadow.umbra_radius, to.shadow.umbra_radius),
                            .penumbra_radius = mix(from.shadow.penumbra_radius, to.shadow.penumbra_radius),
                            .sunlit = mix(from.shadow.sunlit, to.shadow.sunlit)},
                 .planets = {}};
    for (std::size_t i = 0; i < kPlanetCount; ++i) {
        const SlowPlanet& a = from.planets[i];
        const SlowPlanet& b = to.planets[i];
        slow.planets[i] = {.path_km = mix(a.path_km, b.path_km),
                           .to_sun = mix(a.to_sun, b.to_sun),
                           .magnitude = mix(a.magnitude, b.magnitude)};
    }
    return slow;
}

}  // namespace skyig::server::ephemeris
