// How bright the bodies are and how the Moon turns its face: against JPL Horizons and NASA's table of
// libration.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/magnitude.h"
#include "server/ephemeris/moon_face.h"
#include "server/ephemeris/places.h"
#include "server/ephemeris/slow_sky.h"
#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/truth.h"

namespace skyig::server::ephemeris {
namespace {

using tests::CsvRow;
using tests::ErrorStatistics;
using tests::kRadPerDeg;

Instant instant_at(const std::string& utc) {
    return make_instant(UtcClockTime::from_civil(tests::civil_of(utc)).value());
}

double wrapped_deg(double angle_deg) {
    return std::remainder(angle_deg, 360.0);
}

TEST(Magnitude, HorizonsAgreesOnEveryBody) {
    const std::vector<CsvRow> rows = tests::read_csv(SKYIG_REFERENCE "/ephemeris/horizons_mag_phase.csv");
    if (rows.empty()) GTEST_SKIP() << "the table horizons_mag_phase.csv is not part of this clone";
    std::array<ErrorStatistics, kBodyCount> magnitude;
    std::array<ErrorStatistics, kBodyCount> phase_deg;
    std::array<ErrorStatistics, kBodyCount> distance_ppm;
    for (const CsvRow& row : rows) {
        const Body body = tests::body_of(row);
        const ApparentPlace place = compute_geocentric(instant_at(row.text("date_ut")).tt).of(body);
        if (!row.text("v_mag").empty()) magnitude[index_of(body)].add(place.magnitude - row.number("v_mag"));
        phase_deg[index_of(body)].add(place.phase_angle_rad / kRadPerDeg - row.number("phase_angle_deg"));
        distance_ppm[index_of(body)].add(
            (place.distance_km / 149597870.7 / row.number("delta_earth_au") - 1.0) * 1e6);
    }
    for (const Body body : kBodies) {
        const std::size_t i = index_of(body);
        if (phase_deg[i].count == 0) continue;
        std::printf("%s: %zu magnitudes, max %.3f; phase angle %.4f deg; distance %.1f ppm\n",
                    std::string(name_of(body)).c_str(), magnitude[i].count, magnitude[i].max,
                    phase_deg[i].max, distance_ppm[i].max);
        EXPECT_LE(magnitude[i].max, 0.1) << name_of(body);
        // Theirs is the angle between apparent places: up to twice the aberration from ours, which lights the
        // body.
        EXPECT_LE(phase_deg[i].max, 0.0125) << name_of(body);
        EXPECT_LE(distance_ppm[i].max, 5.0) << name_of(body);
    }
    EXPECT_GT(magnitude[index_of(Body::kMoon)].count, 50U);
}

TEST(Magnitude, SaturnShinesWithItsRings) {
    // Oppositions with the rings edge on (2009-03-08, +0.5) and wide open (2017-06-15, 0.0; 2003-12-31,
    // -0.5): published magnitudes, to a tenth.
    const auto saturn = [](const char* utc) {
        return compute_geocentric(instant_at(utc).tt).of(Body::kSaturn).magnitude;
    };
    const double edge_on = saturn("2009-03-08T20:00:00");
    const double open = saturn("2017-06-15T10:00:00");
    const double open_and_near = saturn("2003-12-31T21:00:00");
    std::printf("Saturn in opposition: %.2f edge on, %.2f open, %.2f open and near\n", edge_on, open,
                open_and_near);
    EXPECT_NEAR(edge_on, 0.5, 0.1);
    EXPECT_NEAR(open, 0.0, 0.1);
    EXPECT_NEAR(open_and_near, -0.5, 0.1);
}

TEST(Magnitude, RingsAreDarkWhenTheSunLightsTheirOtherSide) {
    const double open = ring_inclination_rad({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, 0.0);
    EXPECT_NEAR(open, 83.537 * kRadPerDeg, 1e-12);
    EXPECT_EQ(ring_inclination_rad({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.0), 0.0);
}

TEST(Magnitude, IsFiniteAndSteadyForEveryPhase) {
    for (const Body body : kBodies) {
        if (body == Body::kSun || body == Body::kMoon) continue;
        double before = planet_magnitude(body, {.ring_inclination_rad = 0.4});
        double largest_step = 0.0;
        for (double phase_deg = 0.0; phase_deg <= 180.0; phase_deg += 0.05) {
            const double now = planet_magnitude(
                body, {.phase_angle_rad = phase_deg * kRadPerDeg, .ring_inclination_rad = 0.4});
            ASSERT_TRUE(std::isfinite(now));
            tests::raise(largest_step, now - before);
            before = now;
        }
        // Venus steps by 0.15 where its crescent gives way to its glowing air, Mars by 0.02 at 50 deg.
        EXPECT_LE(largest_step, 0.2) << name_of(body);
    }
    EXPECT_NEAR(sun_magnitude(1.0), -26.74, 1e-12);
    EXPECT_NEAR(moon_magnitude(1.0, 384400.0 / 149597870.7, 0.0), -12.72, 0.01);
}

TEST(MoonFace, LibrationHoldsInEveryRow) {
    const std::vector<CsvRow> rows = tests::read_csv(SKYIG_REFERENCE "/ephemeris/libration.csv");
    if (rows.empty()) GTEST_SKIP() << "the table libration.csv is not part of this clone";
    std::array<ErrorStatistics, 5> error_deg;
    ErrorStatistics of_date_deg;
    for (const CsvRow& row : rows) {
        const MoonFace face = compute_geocentric(instant_at(row.text("utc")).tt).moon_face;
        const auto add = [&row](ErrorStatistics& errors, double angle_rad, const char* column) {
            errors.add(wrapped_deg(angle_rad / kRadPerDeg - row.number(column)));
        };
        add(error_deg[0], face.subearth_longitude_rad, "subearth_lon_deg");
        add(error_deg[1], face.subearth_latitude_rad, "subearth_lat_deg");
        add(error_deg[2], face.subsolar_longitude_rad, "subsolar_lon_deg");
        add(error_deg[3], face.subsolar_latitude_rad, "subsolar_lat_deg");
        add(error_deg[4], face.axis_j2000_rad, "axis_pa_deg");
        add(of_date_deg, face.axis_of_date_rad, "axis_pa_deg");
    }
    constexpr std::array kNames{"sub-Earth longitude", "sub-Earth latitude", "sub-solar longitude",
                                "sub-solar latitude", "axis from the pole of J2000"};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        std::printf("%s: max %.4f rms %.4f deg\n", kNames[i], error_deg[i].max, error_deg[i].rms());
        EXPECT_LE(error_deg[i].max, 0.06) << kNames[i];
    }
    std::printf("axis from the pole of date: differs by %.4f deg\n", of_date_deg.max);
    EXPECT_GT(of_date_deg.max, 0.08);
    EXPECT_GE(error_deg[0].count, 173U);
}

TEST(MoonFace, IsMeeusExample) {
    // Astronomical Algorithms, example 53.a, 1992-04-12 0h TD: optical libration l' = -1.206, b' = +4.194,
    // sub-solar point of the optical part 67.89, 1.46; axis of date 15.08 deg (with physical libration).
    const MoonFace face = compute_geocentric({2448724.5, 0.0}).moon_face;
    std::printf("Meeus 53.a: l' %.3f b' %.3f, Sun %.2f %.2f, axis %.2f deg\n",
                face.subearth_longitude_rad / kRadPerDeg, face.subearth_latitude_rad / kRadPerDeg,
                face.subsolar_longitude_rad / kRadPerDeg, face.subsolar_latitude_rad / kRadPerDeg,
                face.axis_of_date_rad / kRadPerDeg);
    EXPECT_NEAR(face.subearth_longitude_rad / kRadPerDeg, -1.206, 0.01);
    EXPECT_NEAR(face.subearth_latitude_rad / kRadPerDeg, 4.194, 0.01);
    EXPECT_NEAR(face.subsolar_longitude_rad / kRadPerDeg, 67.89, 0.05);
    EXPECT_NEAR(face.subsolar_latitude_rad / kRadPerDeg, 1.46, 0.05);
    EXPECT_NEAR(face.axis_of_date_rad / kRadPerDeg, 15.08, 0.05);
}

TEST(MoonFace, ShowsTheSameSideWithTheRightWayUpFromEverywhere) {
    // Seen from the north the Moon's north is up when it culminates in the south; from the south it is down.
    const Instant instant = instant_at("2026-02-01T22:00:00");
    for (const double latitude_deg : {60.0, -60.0}) {
        for (const double longitude_deg : {-180.0, -60.0, 0.0, 75.0}) {
            const SkyState state = compute_sky_state(instant, {latitude_deg, longitude_deg, 0.0});
            const MoonState& moon = state.moon;
            const glm::dmat3& axes = moon.enu_from_selenographic;
            const glm::dmat3 product = glm::transpose(axes) * axes;
            for (glm::length_t i = 0; i < 3; ++i) {
                for (glm::length_t j = 0; j < 3; ++j)
                    EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 1e-7);
            }
            // The near side's middle looks at the eye within the libration and the parallax.
            EXPECT_LE(angle_between_rad(axes[0], -moon.direction_enu), 12.0 * kRadPerDeg);
            // The axis leans on the celestial pole of date by at most obliquity, inclination and libration.
            EXPECT_LE(std::abs(moon_face(state).axis_of_date_rad), 27.0 * kRadPerDeg);
            const MoonFace geocentric = compute_geocentric(instant.tt).moon_face;
            const MoonFace topocentric = moon_face(state);
            EXPECT_NEAR(topocentric.subearth_longitude_rad, geocentric.subearth_longitude_rad,
                        1.1 * kRadPerDeg);
            EXPECT_NEAR(topocentric.subearth_latitude_rad, geocentric.subearth_latitude_rad,
                        1.1 * kRadPerDeg);
            EXPECT_NEAR(topocentric.subsolar_longitude_rad, geocentric.subsolar_longitude_rad, 1e-3);
        }
    }
}

TEST(MoonFace, LightOnTheFaceIsTheLightOfThePhase) {
    // The angle between the sub-solar and the sub-Earth point is the phase angle, whatever way it is
    // computed.
    const SkyState state = compute_sky_state(instant_at("2026-03-10T03:00:00"), {-35.0, 149.0, 600.0});
    const MoonFace face = moon_face(state);
    const auto point = [](double longitude, double latitude) {
        return glm::dvec3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                          std::sin(latitude));
    };
    const double between = angle_between_rad(point(face.subearth_longitude_rad, face.subearth_latitude_rad),
                                             point(face.subsolar_longitude_rad, face.subsolar_latitude_rad));
    EXPECT_NEAR(between, state.moon.phase_angle_rad, 1e-8);
}

}  // namespace
}  // namespace skyig::server::ephemeris
