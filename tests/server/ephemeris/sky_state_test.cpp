// The sky state where it is hard: poles, antimeridian, orbit, eclipses, new Moon, ends of the years, garbage.
#include "server/ephemeris/sky_state.h"

#include <erfa.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <GeographicLib/Geocentric.hpp>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "server/ephemeris/places.h"
#include "server/ephemeris/slow_sky.h"
#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/truth.h"

namespace skyig::server::ephemeris {
namespace {

using tests::kArcsecPerRad;
using tests::kRadPerDeg;
using tests::separation_arcsec;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding_arcsec = 1e-7;

Instant instant_at(std::string_view utc) {
    return make_instant(parse_utc(utc).value());
}

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void expect_sound(const SkyState& state) {
    for (const glm::dvec3& direction :
         {state.sun.direction_enu, state.moon.direction_enu, state.moon.to_sun_enu}) {
        ASSERT_TRUE(finite(direction));
        EXPECT_NEAR(glm::length(direction), 1.0, 1e-13);
    }
    const glm::dmat3 product = state.enu_from_gcrs * glm::transpose(state.enu_from_gcrs);
    for (glm::length_t column = 0; column < 3; ++column) {
        for (glm::length_t row = 0; row < 3; ++row)
            EXPECT_NEAR(product[column][row], column == row ? 1.0 : 0.0, 1e-12);
    }
    EXPECT_NEAR(glm::determinant(state.enu_from_gcrs), 1.0, 1e-12);
    EXPECT_NEAR(state.sun.distance_au, 1.0, 0.02);
    EXPECT_NEAR(glm::length(state.earth_velocity_c), 1e-4, 3e-6);
    EXPECT_GE(state.sun.obscured, 0.0);
    EXPECT_LE(state.sun.obscured, 1.0);
    EXPECT_GE(state.moon.phase_angle_rad, 0.0);
    EXPECT_LE(state.moon.phase_angle_rad, std::numbers::pi);
    EXPECT_NEAR(state.moon.lit_fraction, 0.5 * (1.0 + std::cos(state.moon.phase_angle_rad)), 1e-12);
    EXPECT_TRUE(std::isfinite(state.moon.bright_limb_rad));
    EXPECT_TRUE(finite(state.moon.shadow_axis_enu));
    EXPECT_GT(state.moon.penumbra_radius, state.moon.umbra_radius);
    EXPECT_GT(state.moon.umbra_radius, 2.0);
    EXPECT_GE(state.moon.sunlit, 0.0);
    EXPECT_LE(state.moon.sunlit, 1.0);
    EXPECT_GT(state.moon.magnitude, -14.0);
    EXPECT_LT(state.moon.magnitude, 0.0);
    EXPECT_NEAR(glm::determinant(state.moon.enu_from_selenographic), 1.0, 1e-7);
    EXPECT_NEAR(glm::determinant(state.true_of_date_from_gcrs), 1.0, 1e-12);
    for (const PlanetState& planet : state.planets) {
        ASSERT_TRUE(finite(planet.direction_enu));
        EXPECT_NEAR(glm::length(planet.direction_enu), 1.0, 1e-13);
        EXPECT_NEAR(planet.lit_fraction, 0.5 * (1.0 + std::cos(planet.phase_angle_rad)), 1e-12);
        EXPECT_GT(planet.distance_km, 3e7);
        EXPECT_GT(planet.angular_radius_rad, 5e-6);
        EXPECT_LT(planet.angular_radius_rad, 2e-4);
        EXPECT_GT(planet.magnitude, -5.5);
        EXPECT_LT(planet.magnitude, 9.0);
        EXPECT_LE(std::abs(planet.bright_limb_rad), std::numbers::pi);
    }
}

double largest_difference_arcsec(const SkyState& a, const SkyState& b) {
    double largest_arcsec = 0.0;
    tests::raise(largest_arcsec, separation_arcsec(a.sun.direction_enu, b.sun.direction_enu));
    tests::raise(largest_arcsec, separation_arcsec(a.moon.direction_enu, b.moon.direction_enu));
    tests::raise(largest_arcsec, separation_arcsec(a.enu_from_gcrs[0], b.enu_from_gcrs[0]));
    tests::raise(largest_arcsec, separation_arcsec(a.enu_from_gcrs[2], b.enu_from_gcrs[2]));
    return largest_arcsec;
}

TEST(SkyState, IsSoundEverywhereAndAtAllTimes) {
    for (const std::string_view utc :
         {"1900-01-01T00:00:00Z", "1972-06-30T23:59:60.5Z", "1999-12-31T23:59:59.999Z",
          "2000-02-29T12:00:00Z", "2038-01-19T03:14:08Z", "2100-02-28T23:59:59Z", "2100-12-31T23:59:59Z"}) {
        for (const double latitude_deg : {-90.0, -45.0, 0.0, 1e-300, 66.5, 90.0}) {
            for (const double longitude_deg : {-180.0, -83.0, 0.0, 179.999999, 180.0, 540.0}) {
                for (const double height_m : {-430.0, 0.0, 18288.0, 400e3, 36e6}) {
                    const Geodetic eye{latitude_deg, longitude_deg, height_m};
                    EXPECT_TRUE(is_valid(eye));
                    expect_sound(compute_sky_state(instant_at(utc), eye));
                }
            }
        }
    }
}

TEST(SkyState, KeepsTheMeridianOfTheLongitudeAtThePoles) {
    const Instant instant = instant_at("2026-06-21T12:00:00Z");
    for (const double latitude_deg : {90.0, -90.0}) {
        const double inside_deg = std::copysign(90.0 - 1e-9, latitude_deg);
        for (const double longitude_deg : {0.0, 37.0, 90.0, -180.0}) {
            const SkyState exact = compute_sky_state(instant, {latitude_deg, longitude_deg, 0.0});
            const SkyState beside = compute_sky_state(instant, {inside_deg, longitude_deg, 0.0});
            EXPECT_LE(largest_difference_arcsec(exact, beside), 1e-5);
        }
        // Turning the longitude turns the picture about the vertical and nothing else.
        const SkyState zero = compute_sky_state(instant, {latitude_deg, 0.0, 0.0});
        const SkyState turned = compute_sky_state(instant, {latitude_deg, 90.0, 0.0});
        EXPECT_NEAR(zero.sun.direction_enu.z, turned.sun.direction_enu.z, 1e-14);
        EXPECT_GT(separation_arcsec(zero.sun.direction_enu, turned.sun.direction_enu), 3600.0);
    }
}

TEST(SkyState, IsTheSameOnBothSidesOfTheAntimeridian) {
    for (const std::string_view utc : {"2026-06-21T00:00:00Z", "2026-12-21T12:00:00Z"}) {
        const Instant instant = instant_at(utc);
        const SkyState west = compute_sky_state(instant, {-17.0, -180.0, 10.0});
        EXPECT_LE(largest_difference_arcsec(west, compute_sky_state(instant, {-17.0, 180.0, 10.0})),
                  kRounding_arcsec);
        EXPECT_LE(largest_difference_arcsec(west, compute_sky_state(instant, {-17.0, 540.0, 10.0})),
                  kRounding_arcsec);
        EXPECT_LE(largest_difference_arcsec(west, compute_sky_state(instant, {-17.0, 180.0 - 1e-10, 10.0})),
                  1e-5);
    }
}

TEST(SkyState, StandsWhereGeographicLibPutsTheEye) {
    // The eye's place and axes show in the parallax: two eyes at one time see the Moon along lines that meet
    // in it.
    const Instant instant = instant_at("2026-03-03T11:00:00Z");
    const SkyState base = compute_sky_state(instant, {0.0, 0.0, 0.0});
    const auto moon_ecef_km = [&](const Geodetic& eye) {
        double x = 0.0;
        double y = 0.0;
        double z = 0.0;
        std::vector<double> ecef_from_enu(9);
        GeographicLib::Geocentric::WGS84().Forward(eye.latitude_deg, eye.longitude_deg, eye.height_m, x, y, z,
                                                   ecef_from_enu);
        const std::vector<double>& m = ecef_from_enu;
        const glm::dmat3 rotation(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]);
        const MoonState moon = compute_sky_state(instant, eye).moon;
        return 1e-3 * glm::dvec3(x, y, z) + rotation * (moon.distance_km * moon.direction_enu);
    };
    const glm::dvec3 reference_km = moon_ecef_km({0.0, 0.0, 0.0});
    double largest_km = 0.0;
    for (const Geodetic& eye :
         {Geodetic{52.0, 13.0, 40.0}, Geodetic{-77.0, 166.0, 12000.0}, Geodetic{31.5, 35.5, -430.0},
          Geodetic{90.0, 0.0, 0.0}, Geodetic{0.0, 180.0, 400e3}, Geodetic{10.0, -90.0, 36e6}}) {
        tests::raise(largest_km, glm::length(moon_ecef_km(eye) - reference_km));
    }
    std::printf("lines of sight to the Moon meet within %.2f km at %.0f km\n", largest_km,
                base.moon.distance_km);
    // The rest is real: light time and aberration differ from eye to eye (0.02 s and 0.3 arcsec at the
    // Earth's surface).
    EXPECT_LE(largest_km, 4.5);
}

TEST(SkyState, SeesTheSunWhereThePublishedExampleDoes) {
    // Published worked example of the NREL solar position algorithm: 2003-10-17 19:30:30 UT, delta-T 67 s.
    Instant instant;
    instant.ut1 = {2452929.5, 70230.0 / 86400.0};
    instant.tt = {2452929.5, 70297.0 / 86400.0};
    const SkyState state = compute_sky_state(instant, {39.742476, -105.1786, 1830.14});
    // Zenith 50.11162 and azimuth 194.34024 there, with a refraction of 0.01633 deg that is taken off again.
    const glm::dvec3 published = tests::direction_of(194.34024, 90.0 - 50.11162 - 0.01633);
    const double error_arcsec = separation_arcsec(state.sun.direction_enu, published);
    std::printf("NREL example: %.2f arcsec\n", error_arcsec);
    EXPECT_LE(error_arcsec, 1.0);
}

TEST(SkyState, TurnsStarsTheWayItTurnsTheSun) {
    // Polaris at J2000 stands within a degree of the pole: at 50 N it is seen 50 degrees up in the north.
    const double ra = 37.9529 * kRadPerDeg;
    const double dec = 89.2642 * kRadPerDeg;
    const glm::dvec3 polaris(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec));
    for (const std::string_view utc :
         {"2026-01-01T00:00:00Z", "2026-01-01T12:00:00Z", "2026-07-01T06:00:00Z"}) {
        const SkyState state = compute_sky_state(instant_at(utc), {50.0, 10.0, 0.0});
        const double from_pole_deg =
            separation_arcsec(state.enu_from_gcrs * polaris, tests::direction_of(0.0, 50.0)) / 3600.0;
        EXPECT_NEAR(from_pole_deg, 0.63, 0.03) << utc;
    }
}

TEST(SkyState, PutsStarsWhereErfaDoes) {
    // Matrix and annual aberration against ERFA's whole catalogue-to-observed chain (00A nutation, deflection
    // by the Sun).
    double largest_arcsec = 0.0;
    for (const double ra_deg : {10.0, 101.3, 190.0, 279.2}) {
        for (const double dec_deg : {-80.0, -16.7, 38.8, 89.3}) {
            const double ra = ra_deg * kRadPerDeg;
            const double dec = dec_deg * kRadPerDeg;
            const UtcClockTime utc = parse_utc("2026-02-03T04:05:06Z").value();
            constexpr Geodetic kEye{-33.9, 151.2, 3000.0};
            double az = 0.0;
            double zenith = 0.0;
            double unused[4]{};
            ASSERT_GE(
                eraAtco13(ra, dec, 0.0, 0.0, 0.0, 0.0, 2400000.5 + utc.mjd(),
                          utc.second_of_day() / tests::kSecondsPerDay, 0.0, kEye.longitude_deg * kRadPerDeg,
                          kEye.latitude_deg * kRadPerDeg, kEye.height_m, 0.0, 0.0, 0.0, 0.0, 0.0, 0.55, &az,
                          &zenith, &unused[0], &unused[1], &unused[2], &unused[3]),
                0);
            const SkyState state = compute_sky_state(make_instant(utc, 0.0), kEye);
            const glm::dvec3 star(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec));
            const glm::dvec3 seen = state.enu_from_gcrs * glm::normalize(star + state.earth_velocity_c);
            const glm::dvec3 truth(std::sin(az) * std::sin(zenith), std::cos(az) * std::sin(zenith),
                                   std::cos(zenith));
            tests::raise(largest_arcsec, separation_arcsec(seen, truth));
        }
    }
    std::printf("stars against ERFA's chain: max %.3f arcsec\n", largest_arcsec);
    // Diurnal aberration, 0.27 arcsec at this latitude, is what the star matrix leaves out.
    EXPECT_LE(largest_arcsec, 0.35);
}

TEST(SkyState, GivesTheEarthItsVelocityAndYears) {
    // In January the Earth moves towards right ascension 12h, faster than its mean 29.78 km/s.
    const SkyState state = compute_sky_state(instant_at("2026-01-04T00:00:00Z"), {});
    EXPECT_NEAR(glm::length(state.earth_velocity_c) * 299792.458, 30.29, 0.05);
    EXPECT_LT(state.earth_velocity_c.x, -0.9 * glm::length(state.earth_velocity_c));
    EXPECT_NEAR(state.years_since_j2000, 9499.5 / 365.25, 1e-5);
    EXPECT_NEAR(state.sun.distance_au, 0.9833, 0.0002);
}

TEST(SkyState, LightsTheNewMoonFromBehind) {
    // Conjunction of 2024-04-08 away from the eclipse's track: the Sun shines past the Moon, on its far side.
    const SkyState state = compute_sky_state(instant_at("2024-04-08T18:21:00Z"), {-34.0, 18.5, 0.0});
    EXPECT_GT(state.moon.phase_angle_rad, 177.0 * kRadPerDeg);
    EXPECT_LT(state.moon.lit_fraction, 0.001);
    // Seen on the sky the crescent points to the Sun.
    const glm::dvec3 moon = state.moon.direction_enu;
    const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, moon) * moon; };
    const double misaligned_rad =
        angle_between_rad(across(state.moon.to_sun_enu), across(state.sun.direction_enu));
    std::printf("new Moon: phase %.3f deg, crescent off the Sun's direction by %.4f deg\n",
                state.moon.phase_angle_rad / kRadPerDeg, misaligned_rad / kRadPerDeg);
    EXPECT_LE(misaligned_rad, 0.05 * kRadPerDeg);
}

TEST(SkyState, PointsTheBrightLimbAsMeeusDoes) {
    // Meeus, Astronomical Algorithms, example 48.a: 1992-04-12 0h TD, k = 0.6786, chi = 285.0 deg,
    // geocentric.
    Instant instant;
    instant.tt = {2448724.5, 0.0};
    instant.ut1 = {2448724.5, -58.7 / 86400.0};
    // A distant eye on the side towards the Moon would change the parallax; the Moon at the zenith leaves chi
    // alone.
    const MoonState from_equator = compute_sky_state(instant, {13.77, -65.0, 0.0}).moon;
    EXPECT_NEAR(from_equator.lit_fraction, 0.6786, 0.01);
    const double chi_deg = std::fmod(from_equator.bright_limb_rad / kRadPerDeg + 360.0, 360.0);
    std::printf("bright limb %.2f deg (285.0), lit %.4f (0.6786)\n", chi_deg, from_equator.lit_fraction);
    EXPECT_NEAR(chi_deg, 285.0, 0.5);
}

TEST(SkyState, EclipsesTheSunOn20240408) {
    const Geodetic ohio{41.0341, -83.6523, 0.0};
    const SkyState total = compute_sky_state(instant_at("2024-04-08T19:12:37Z"), ohio);
    EXPECT_EQ(total.sun.obscured, 1.0);
    EXPECT_LT(separation_arcsec(total.sun.direction_enu, total.moon.direction_enu), 30.0);
    const SkyState partial = compute_sky_state(instant_at("2024-04-08T18:32:37Z"), ohio);
    EXPECT_GT(partial.sun.obscured, 0.3);
    EXPECT_LT(partial.sun.obscured, 0.5);
    EXPECT_EQ(compute_sky_state(instant_at("2024-04-08T12:00:00Z"), ohio).sun.obscured, 0.0);
}

TEST(SkyState, RefusesSitesThatAreNone) {
    const Instant instant = instant_at("2026-06-21T12:00:00Z");
    for (const Geodetic& eye :
         {Geodetic{kNan, 0.0, 0.0}, Geodetic{0.0, kNan, 0.0}, Geodetic{0.0, 0.0, kNan},
          Geodetic{kInfinity, 0.0, 0.0}, Geodetic{0.0, -kInfinity, 0.0}, Geodetic{0.0, 0.0, kInfinity},
          Geodetic{90.001, 0.0, 0.0}, Geodetic{-91.0, 0.0, 0.0}, Geodetic{0.0, 0.0, -6.4e6},
          Geodetic{0.0, 0.0, 1e12}}) {
        EXPECT_FALSE(is_valid(eye));
        const SkyState state = compute_sky_state(instant, eye);
        EXPECT_FALSE(state.eye_accepted);
        expect_sound(state);
    }
    EXPECT_TRUE(compute_sky_state(instant, {}).eye_accepted);
}

TEST(SkyState, MovesPhasesOfPlanetsWithTheEye) {
    // By vectors from the Earth's centre: Venus and Mars near the Earth from far up on either side.
    const Instant instant = instant_at("2020-05-20T06:00:00Z");
    const SkyState centre = geocentric_state_from(evaluate_slow_sky(instant.tt), instant.tt);
    const SlowSky slow = evaluate_slow_sky(instant.tt);
    double largest_arcsec = 0.0;
    double largest_magnitude = 0.0;
    for (const double longitude_deg : {0.0, 90.0, 180.0, 270.0}) {
        const Geodetic eye{0.0, longitude_deg, 36e6};
        const SkyState state = compute_sky_state(instant, eye);
        const glm::dvec3 eye_km = glm::dvec3(0.0, 0.0, 6378.137 + 36e3) * state.enu_from_gcrs;
        for (std::size_t i = 0; i < kPlanetCount; ++i) {
            const glm::dvec3 geocentric_km = slow.planets[i].path_km;
            const glm::dvec3 from_sun_km = geocentric_km - slow.sun_km;
            const double by_vectors = angle_between_rad(geocentric_km - eye_km, from_sun_km) -
                                      angle_between_rad(geocentric_km, from_sun_km);
            const double in_state = state.planets[i].phase_angle_rad - centre.planets[i].phase_angle_rad;
            tests::raise(largest_arcsec, std::abs(by_vectors - in_state) * kArcsecPerRad);
            const double nearer =
                5.0 * std::log10(glm::length(geocentric_km - eye_km) / glm::length(geocentric_km));
            tests::raise(largest_magnitude,
                         state.planets[i].magnitude - centre.planets[i].magnitude - nearer);
        }
    }
    std::printf("phase moved by the eye at 36 000 km: within %.3f arcsec, magnitude within %.6f\n",
                largest_arcsec, largest_magnitude);
    EXPECT_LE(largest_arcsec, 0.01);
    EXPECT_LE(largest_magnitude, 1e-4);
}

TEST(SkyState, LightsPlanetsInTransitForTheEyeAndNotForTheEarthsCentre) {
    // Mercury and Venus before the Sun: what is a small parallax turns the limb by many degrees there.
    struct Transit {
        const char* utc;
        Body body;
        Geodetic eye;
    };
    const Geodetic fiji{-16.8, -179.99, 10.0};
    double worst_limb_deg = 0.0;
    double worst_phase_arcsec = 0.0;
    for (const Transit& transit : {Transit{"1973-11-10T10:32:00Z", Body::kMercury, {0.0, 0.0, 36e6}},
                                   Transit{"1973-11-10T10:32:00Z", Body::kMercury, {0.0, 150.0, 36e6}},
                                   Transit{"1973-11-10T10:32:00Z", Body::kMercury, {-60.0, -90.0, 36e6}},
                                   Transit{"2004-06-08T08:20:00Z", Body::kVenus, fiji},
                                   Transit{"2004-06-08T08:20:00Z", Body::kVenus, {62.0, 15.0, 0.0}},
                                   Transit{"2012-06-06T01:29:36Z", Body::kVenus, {-35.0, 149.0, 36e6}}}) {
        const SkyState state = compute_sky_state(instant_at(transit.utc), transit.eye);
        const ApparentPlace planet = apparent_place(state, transit.body);
        EXPECT_LE(planet.phase_angle_rad, std::numbers::pi);
        const glm::dvec3 pole = state.enu_from_gcrs * glm::transpose(state.true_of_date_from_gcrs)[2];
        const double limb_rad = position_angle_rad(planet.direction, state.sun.direction_enu, pole);
        tests::raise(worst_limb_deg,
                     std::remainder(planet.bright_limb_rad - limb_rad, 2.0 * std::numbers::pi) / kRadPerDeg);
        const glm::dvec3 planet_km = planet.distance_km * planet.direction;
        const glm::dvec3 sun_km = apparent_place(state, Body::kSun).distance_km * state.sun.direction_enu;
        tests::raise(
            worst_phase_arcsec,
            (angle_between_rad(-planet_km, sun_km - planet_km) - planet.phase_angle_rad) * kArcsecPerRad);
    }
    std::printf("planets in transit: limb within %.4f deg, phase angle within %.3f arcsec\n", worst_limb_deg,
                worst_phase_arcsec);
    EXPECT_LE(worst_limb_deg, 0.05);
    EXPECT_LE(worst_phase_arcsec, 1.0);
}

TEST(SkyState, BendsPlanetsAroundTheSunAndPutsThemInFrontUnbent) {
    // Transit of Venus, 2012-06-06: seen before the Sun, least separation 554 arcsec for the Earth's centre
    // at 01:29:36 UT (published). Bending would have pushed it off by more than an arcsec.
    const Instant transit = instant_at("2012-06-06T01:29:36Z");
    const GeocentricPlaces places = compute_geocentric(transit.tt);
    const double transit_arcsec =
        separation_arcsec(places.of(Body::kSun).direction, places.of(Body::kVenus).direction);
    // Superior conjunctions of Mercury lead behind the Sun: no place goes astray there.
    double largest_step_arcsec = 0.0;
    glm::dvec3 before{0.0};
    for (int minute = 0; minute < 6 * 1440; minute += 10) {
        UtcClockTime time = parse_utc("2023-04-01T00:00:00Z").value();
        time.advance(60.0 * minute);
        const glm::dvec3 now =
            compute_geocentric(make_instant(time).tt, Model::kAlmanac).of(Body::kMercury).direction;
        if (minute > 0) tests::raise(largest_step_arcsec, separation_arcsec(now, before));
        before = now;
    }
    std::printf("transit of Venus at %.1f arcsec (554.4); Mercury moves %.1f arcsec in ten minutes\n",
                transit_arcsec, largest_step_arcsec);
    EXPECT_NEAR(transit_arcsec, 554.4, 0.7);
    EXPECT_LE(largest_step_arcsec, 60.0);
}

TEST(SkyState, NamesDirectionsForPeople) {
    const Horizontal east = horizontal_of({1.0, 0.0, 1.0});
    EXPECT_NEAR(east.azimuth_rad, std::numbers::pi / 2.0, 1e-15);
    EXPECT_NEAR(east.elevation_rad, std::numbers::pi / 4.0, 1e-15);
    EXPECT_NEAR(horizontal_of({-1.0, 0.0, 0.0}).azimuth_rad, 1.5 * std::numbers::pi, 1e-15);
    EXPECT_EQ(horizontal_of({-1e-300, 1.0, 0.0}).azimuth_rad, 0.0);
    EXPECT_EQ(horizontal_of({0.0, 0.0, 1.0}).azimuth_rad, 0.0);
    EXPECT_NEAR(horizontal_of({0.0, 0.0, -2.0}).elevation_rad, -std::numbers::pi / 2.0, 1e-15);
    const Equatorial pole = equatorial_of({0.0, 0.0, 1.0});
    EXPECT_EQ(pole.right_ascension_rad, 0.0);
    EXPECT_NEAR(pole.declination_rad, std::numbers::pi / 2.0, 1e-15);
    EXPECT_NEAR(equatorial_of({0.0, -1.0, -1.0}).right_ascension_rad, 1.5 * std::numbers::pi, 1e-15);
    // The zenith's declination is the geodetic latitude, its right ascension the sidereal time.
    const Geodetic eye{-33.9, 151.2, 3000.0};
    const Instant instant = instant_at("2026-02-03T04:05:06Z");
    const Equatorial zenith = equatorial_of_date(compute_sky_state(instant, eye), {0.0, 0.0, 1.0});
    EXPECT_NEAR(zenith.declination_rad, eye.latitude_deg * kRadPerDeg, 1e-12);
    const double sidereal_rad =
        eraGst06a(instant.ut1.day, instant.ut1.fraction, instant.tt.day, instant.tt.fraction) +
        eye.longitude_deg * kRadPerDeg;
    const double error_arcsec =
        std::remainder(zenith.right_ascension_rad - sidereal_rad, 2.0 * std::numbers::pi) * kArcsecPerRad;
    std::printf("sidereal time: %.5f arcsec from IAU 2006/2000A\n", error_arcsec);
    EXPECT_LE(std::abs(error_arcsec), 0.003);
}

TEST(SkyState, SeesABodyInTheZenith) {
    // Over the point that has the Sun in its zenith azimuth is without meaning; the rest stays whole.
    const Instant instant = instant_at("2026-06-21T12:00:00Z");
    const SkyState first = compute_sky_state(instant, {23.0, 0.0, 0.0});
    const Equatorial sun = equatorial_of_date(first, first.sun.direction_enu);
    const Equatorial up = equatorial_of_date(first, {0.0, 0.0, 1.0});
    Geodetic eye{
        sun.declination_rad / kRadPerDeg,
        std::remainder(sun.right_ascension_rad - up.right_ascension_rad, 2.0 * std::numbers::pi) / kRadPerDeg,
        0.0};
    const SkyState state = compute_sky_state(instant, eye);
    const double off_arcsec = separation_arcsec(state.sun.direction_enu, {0.0, 0.0, 1.0});
    std::printf("Sun %.2f arcsec from the zenith\n", off_arcsec);
    EXPECT_LE(off_arcsec, 10.0);
    expect_sound(state);
}

TEST(CoveredFraction, IsTheLensArea) {
    EXPECT_EQ(covered_fraction(1.0, 1.0, 2.0), 0.0);
    EXPECT_EQ(covered_fraction(1.0, 1.0, 0.0), 1.0);
    EXPECT_EQ(covered_fraction(1.0, 1.1, 0.1), 1.0);
    EXPECT_EQ(covered_fraction(1.0, 0.5, 0.25), 0.25);
    EXPECT_EQ(covered_fraction(0.0, 1.0, 0.5), 1.0);
    EXPECT_EQ(covered_fraction(0.0, 1.0, 1.5), 0.0);
    // Two unit circles at distance one: 2 pi / 3 - sqrt(3) / 2 in common.
    EXPECT_NEAR(covered_fraction(1.0, 1.0, 1.0), 2.0 / 3.0 - std::sqrt(3.0) / 2.0 / std::numbers::pi, 1e-15);
    // A straight edge through the middle covers half.
    EXPECT_NEAR(covered_fraction(1.0, 1e6, 1e6), 0.5, 1e-6);
}

TEST(CoveredFraction, FallsSteadilyAndMeetsItsEnds) {
    constexpr double kSun = 0.004652;
    for (const double moon : {0.00428, 0.004652, 0.00488}) {
        double before = covered_fraction(kSun, moon, 0.0);
        const int steps = 20000;
        double largest_step = 0.0;
        for (int i = 1; i <= steps; ++i) {
            const double now = covered_fraction(kSun, moon, (kSun + moon) * 1.01 * i / steps);
            EXPECT_LE(now, before + 1e-12);
            tests::raise(largest_step, before - now);
            before = now;
        }
        EXPECT_EQ(before, 0.0);
        EXPECT_LE(largest_step, 1e-4);
    }
}

TEST(AngleBetween, ResolvesSmallAndOppositeAngles) {
    const glm::dvec3 x(1.0, 0.0, 0.0);
    EXPECT_NEAR(angle_between_rad(x, glm::dvec3(1.0, 1e-12, 0.0)), 1e-12, 1e-27);
    EXPECT_NEAR(std::numbers::pi - angle_between_rad(x, glm::dvec3(-1.0, 1e-9, 0.0)), 1e-9, 1e-15);
    EXPECT_EQ(angle_between_rad(x, x), 0.0);
}

}  // namespace
}  // namespace skyig::server::ephemeris
