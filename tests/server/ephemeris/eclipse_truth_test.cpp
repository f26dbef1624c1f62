// Eclipses: the Sun's against NASA's catalogue and profiles from DE441, the Moon's against published contacts
// and against the same shadow computed from angles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/earth_shadow.h"
#include "server/ephemeris/places.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/slow_sky.h"
#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/truth.h"

namespace skyig::server::ephemeris {
namespace {

using tests::CsvRow;
using tests::ErrorStatistics;
using tests::kArcsecPerRad;
using tests::separation_arcsec;

Instant instant_of(const CsvRow& row) {
    return tests::instant_of(row.text("utc"), row.number("tt_minus_utc_s"), row.number("ut1_minus_utc_s"));
}

double sun_moon_arcsec(const SkyState& state) {
    return separation_arcsec(state.sun.direction_enu, state.moon.direction_enu);
}

TEST(SolarEclipses, ProfilesHoldInEveryRow) {
    ErrorStatistics separation;
    ErrorStatistics semidiameter;
    for (const CsvRow& row : tests::read_csv(SKYIG_TEST_DATA "/ephemeris/eclipse_sites.csv")) {
        const SkyState state = compute_sky_state(instant_of(row), tests::place_of(row));
        separation.add(sun_moon_arcsec(state) - row.number("separation_arcsec"));
        semidiameter.add(state.moon.angular_radius_rad * kArcsecPerRad - row.number("moon_semidiam_arcsec"));
        semidiameter.add(state.sun.angular_radius_rad * kArcsecPerRad - row.number("sun_semidiam_arcsec"));
    }
    std::printf("eclipse profiles: %zu rows, separation max %.3f rms %.3f arcsec, semidiameters %.4f\n",
                separation.count, separation.max, separation.rms(), semidiameter.max);
    ASSERT_GE(separation.count, 76U);
    EXPECT_LE(separation.max, 1.0);
    EXPECT_LE(semidiameter.max, 0.01);
}

TEST(SolarEclipses, AreTotalAtEveryPlaceOfTheCatalogue) {
    const std::vector<CsvRow> rows = tests::read_csv(SKYIG_REFERENCE "/ephemeris/eclipse_greatest.csv");
    if (rows.empty()) GTEST_SKIP() << "the table eclipse_greatest.csv is not part of this clone";
    double largest_arcsec = 0.0;
    double least_margin_arcsec = 1e9;
    for (const CsvRow& row : rows) {
        const Instant instant = tests::instant_of(row.text("td_iso"), 0.0, -row.number("catalog_delta_t_s"));
        const Geodetic eye{row.number("lat_deg"), row.number("lon_deg"), 0.0};
        const SkyState state = compute_sky_state(instant, eye);
        const double margin_arcsec =
            (state.moon.angular_radius_rad - state.sun.angular_radius_rad) * kArcsecPerRad -
            sun_moon_arcsec(state);
        tests::raise(largest_arcsec, sun_moon_arcsec(state));
        least_margin_arcsec = std::min(least_margin_arcsec, margin_arcsec);
        EXPECT_GT(margin_arcsec, 0.0) << row.text("td_iso");
        EXPECT_EQ(state.sun.obscured, 1.0) << row.text("td_iso");
    }
    std::printf("%zu total eclipses: separation at most %.1f arcsec, margin at least %.1f\n", rows.size(),
                largest_arcsec, least_margin_arcsec);
}

/// The shadow at `tt`, by the model's own vectors.
EarthShadow shadow_at(const JulianDate& tt) {
    return evaluate_slow_sky(tt).shadow;
}

JulianDate seconds_after(const JulianDate& from, double seconds) {
    return {from.day, from.fraction + seconds / tests::kSecondsPerDay};
}

/// Where `distance of Moon's centre from the axis - limit` crosses zero between two times, seconds after
/// `start`.
template <typename Limit>
double contact_s(const JulianDate& start, double from_s, double to_s, const Limit& limit) {
    const auto inside = [&](double seconds) {
        const EarthShadow shadow = shadow_at(seconds_after(start, seconds));
        return glm::length(shadow.axis) < limit(shadow);
    };
    const bool inside_at_first = inside(from_s);
    EXPECT_NE(inside_at_first, inside(to_s));
    while (to_s - from_s > 0.05) {
        const double middle_s = 0.5 * (from_s + to_s);
        (inside(middle_s) == inside_at_first ? from_s : to_s) = middle_s;
    }
    return 0.5 * (from_s + to_s);
}

TEST(LunarEclipses, ContactsOf20180727AreThePublishedOnes) {
    // Five Millennium Canon (Espenak & Meeus), UT: greatest 20:21:44, gamma 0.1168, umbral magnitude 1.6087,
    // penumbral 2.6792; P1 17:14:49, U1 18:24:27, U2 19:30:15, U3 21:13:12, U4 22:19:00, P4 23:28:37.
    const JulianDate midnight = make_instant(parse_utc("2018-07-27T00:00:00Z").value()).tt;
    const auto at = [](int hour, int minute, int second) { return 3600.0 * hour + 60.0 * minute + second; };
    double greatest_s = 0.0;
    double least = 1e9;
    for (double s = at(20, 15, 0); s < at(20, 30, 0); s += 1.0) {
        const double distance = glm::length(shadow_at(seconds_after(midnight, s)).axis);
        if (distance < least) {
            least = distance;
            greatest_s = s;
        }
    }
    const EarthShadow shadow = shadow_at(seconds_after(midnight, greatest_s));
    const double umbral_magnitude = 0.5 * (shadow.umbra_radius + 1.0 - least);
    const double penumbral_magnitude = 0.5 * (shadow.penumbra_radius + 1.0 - least);
    const double gamma = least * 1737.4 / 6378.137;
    std::printf("2018-07-27: greatest %+.0f s, gamma %.4f, umbral magnitude %.4f, penumbral %.4f\n",
                greatest_s - at(20, 21, 44), gamma, umbral_magnitude, penumbral_magnitude);
    EXPECT_NEAR(greatest_s, at(20, 21, 44), 4.0);
    EXPECT_NEAR(gamma, 0.1168, 0.0003);
    EXPECT_NEAR(umbral_magnitude, 1.6087, 0.003);
    EXPECT_NEAR(penumbral_magnitude, 2.6792, 0.003);

    const auto penumbra = [](const EarthShadow& s) { return s.penumbra_radius + 1.0; };
    const auto partial = [](const EarthShadow& s) { return s.umbra_radius + 1.0; };
    const auto total = [](const EarthShadow& s) { return s.umbra_radius - 1.0; };
    const double p1 = contact_s(midnight, at(16, 0, 0), at(20, 0, 0), penumbra) - at(17, 14, 49);
    const double u1 = contact_s(midnight, at(16, 0, 0), at(20, 0, 0), partial) - at(18, 24, 27);
    const double u2 = contact_s(midnight, at(16, 0, 0), at(20, 0, 0), total) - at(19, 30, 15);
    const double u3 = contact_s(midnight, at(21, 0, 0), at(24, 0, 0), total) - at(21, 13, 12);
    const double u4 = contact_s(midnight, at(21, 0, 0), at(24, 0, 0), partial) - at(22, 19, 0);
    const double p4 = contact_s(midnight, at(21, 0, 0), at(24, 0, 0), penumbra) - at(23, 28, 37);
    std::printf("contacts: P1 %+.1f U1 %+.1f U2 %+.1f U3 %+.1f U4 %+.1f P4 %+.1f s\n", p1, u1, u2, u3, u4,
                p4);
    for (const double late_s : {u1, u2, u3, u4})
        EXPECT_LE(std::abs(late_s), 4.0);
    EXPECT_LE(std::abs(p1), 4.0);
    EXPECT_LE(std::abs(p4), 4.0);
}

TEST(LunarEclipses, MagnitudesAreThePublishedOnes) {
    struct Eclipse {
        const char* greatest_utc;
        double umbral_magnitude;
    };
    // Five Millennium Canon: total 2019 and 2022, partial 2021 and 2024.
    for (const Eclipse& eclipse :
         {Eclipse{"2019-01-21T05:12:16Z", 1.1953}, Eclipse{"2022-11-08T10:59:11Z", 1.3589},
          Eclipse{"2021-11-19T09:02:53Z", 0.9742}, Eclipse{"2024-09-18T02:44:16Z", 0.0849}}) {
        const EarthShadow shadow = shadow_at(make_instant(parse_utc(eclipse.greatest_utc).value()).tt);
        const double magnitude = 0.5 * (shadow.umbra_radius + 1.0 - glm::length(shadow.axis));
        std::printf("%s: umbral magnitude %.4f (%.4f)\n", eclipse.greatest_utc, magnitude,
                    eclipse.umbral_magnitude);
        EXPECT_NEAR(magnitude, eclipse.umbral_magnitude, 0.002);
    }
}

TEST(LunarEclipses, ShadowFromAnglesIsTheSameShadow) {
    // Danjon's rule in angles at the Earth's centre, with apparent places: umbra 1.01 pi_m + pi_s - s, around
    // the point opposite the apparent Sun.
    double worst_offset = 0.0;
    double worst_radius = 0.0;
    const JulianDate start = make_instant(parse_utc("2018-07-27T17:00:00Z").value()).tt;
    for (double s = 0.0; s < 7.0 * 3600.0; s += 600.0) {
        const JulianDate tt = seconds_after(start, s);
        const GeocentricPlaces places = compute_geocentric(tt);
        const ApparentPlace& sun = places.of(Body::kSun);
        const ApparentPlace& moon = places.of(Body::kMoon);
        const double offset_rad = angle_between_rad(-sun.direction, moon.direction);
        const double moon_parallax_rad = std::asin(6378.137 / moon.distance_km);
        const double sun_parallax_rad = std::asin(6378.137 / sun.distance_km);
        const double umbra_rad = 1.01 * moon_parallax_rad + sun_parallax_rad - sun.angular_radius_rad;
        const double penumbra_rad = 1.01 * moon_parallax_rad + sun_parallax_rad + sun.angular_radius_rad;
        const EarthShadow shadow = shadow_at(tt);
        const double moon_radius_rad = moon.angular_radius_rad;
        tests::raise(worst_offset, glm::length(shadow.axis) - offset_rad / moon_radius_rad);
        tests::raise(worst_radius, shadow.umbra_radius - umbra_rad / moon_radius_rad);
        tests::raise(worst_radius, shadow.penumbra_radius - penumbra_rad / moon_radius_rad);
    }
    std::printf("shadow by cones and by angles: offset %.5f, radii %.5f of the Moon's radius\n", worst_offset,
                worst_radius);
    EXPECT_LE(worst_offset, 0.002);
    EXPECT_LE(worst_radius, 0.002);
}

TEST(LunarEclipses, SunlightFallsFromOneToNothingAndBack) {
    const JulianDate start = make_instant(parse_utc("2018-07-27T16:30:00Z").value()).tt;
    const double greatest_s = 3.0 * 3600.0 + 51.0 * 60.0 + 44.0;
    double before = 1.0;
    double largest_step = 0.0;
    EXPECT_EQ(shadow_at(start).sunlit, 1.0);
    for (double s = 0.0; s < greatest_s; s += 30.0) {
        const double now = shadow_at(seconds_after(start, s)).sunlit;
        EXPECT_LE(now, before + 1e-9);
        tests::raise(largest_step, before - now);
        before = now;
    }
    EXPECT_EQ(shadow_at(seconds_after(start, greatest_s)).sunlit, 0.0);
    EXPECT_EQ(shadow_at(seconds_after(start, 2.0 * greatest_s)).sunlit, 1.0);
    std::printf("sunlit: largest step in 30 s %.4f\n", largest_step);
    EXPECT_LE(largest_step, 0.01);
}

TEST(LunarEclipses, MeanSunlightIsTheMeanOverTheDisc) {
    // A fine square grid over the disc against what is done with few points, across the penumbra's edge.
    const double au = 149597870.7;
    const double d = 384400.0;
    double worst = 0.0;
    for (double off_km = 0.0; off_km < 12000.0; off_km += 750.0) {
        const EarthShadow shadow = earth_shadow({d, off_km, 0.0}, {-au, 0.0, 0.0});
        const double sun_radius = 0.5 * (shadow.penumbra_radius - shadow.umbra_radius);
        const double earth_radius = 0.5 * (shadow.penumbra_radius + shadow.umbra_radius);
        double sum = 0.0;
        int points = 0;
        constexpr int kHalf = 60;
        for (int i = -kHalf; i <= kHalf; ++i) {
            for (int j = -kHalf; j <= kHalf; ++j) {
                const double x = static_cast<double>(i) / kHalf;
                const double y = static_cast<double>(j) / kHalf;
                if (x * x + y * y > 1.0) continue;
                const double distance = std::hypot(off_km / 1737.4 + x, y);
                sum += 1.0 - covered_fraction(sun_radius, earth_radius, distance);
                ++points;
            }
        }
        tests::raise(worst, shadow.sunlit - sum / points);
    }
    std::printf("mean sunlight on the disc: off by at most %.5f\n", worst);
    EXPECT_LE(worst, 0.001);
}

TEST(LunarEclipses, ThereIsNoShadowBeforeTheSun) {
    const double au = 149597870.7;
    for (const glm::dvec3& moon_km : {glm::dvec3(-384400.0, 0.0, 0.0), glm::dvec3(-384400.0, 100.0, 5.0),
                                      glm::dvec3(0.0, 384400.0, 0.0)}) {
        const EarthShadow shadow = earth_shadow(moon_km, {-au, 0.0, 0.0});
        EXPECT_EQ(shadow.sunlit, 1.0);
        EXPECT_GT(glm::length(shadow.axis), 100.0);
        EXPECT_TRUE(std::isfinite(shadow.axis.x + shadow.axis.y + shadow.axis.z));
    }
    // Abreast of the Earth the axis is as far as the Earth from either side.
    const EarthShadow lit = earth_shadow({-1.0, 384400.0, 0.0}, {-au, 0.0, 0.0});
    const EarthShadow dark = earth_shadow({1.0, 384400.0, 0.0}, {-au, 0.0, 0.0});
    EXPECT_LE(glm::length(lit.axis - dark.axis), 1e-3);
    EXPECT_NEAR(lit.umbra_radius, dark.umbra_radius, 1e-4);
}

TEST(LunarEclipses, ShadowLiesAcrossTheLightOnTheMoon) {
    // In the state the axis stands across the direction of the light, and above or below by the Moon's own
    // side.
    const Instant instant = make_instant(parse_utc("2018-07-27T18:30:00Z").value());
    const SkyState state = compute_sky_state(instant, {-20.0, 57.0, 0.0});
    EXPECT_LE(std::abs(glm::dot(state.moon.to_sun_enu, glm::normalize(state.moon.shadow_axis_enu))), 1e-3);
    // The Moon goes east into the shadow: its axis lies east of the Moon on the sky.
    const glm::dvec3 pole_enu = state.enu_from_gcrs * glm::transpose(state.true_of_date_from_gcrs)[2];
    EXPECT_GT(std::sin(position_angle_rad(state.moon.direction_enu, state.moon.shadow_axis_enu, pole_enu)),
              0.8);
    EXPECT_GT(state.moon.sunlit, 0.0);
    EXPECT_LT(state.moon.sunlit, 0.9);
}

}  // namespace
}  // namespace skyig::server::ephemeris
