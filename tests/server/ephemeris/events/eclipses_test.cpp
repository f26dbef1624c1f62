// Eclipses: against a canon where the clone has it, against published contact times, and where none is.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "server/ephemeris/events/eclipses.h"
#include "tests/csv.h"
#include "tests/server/ephemeris/largest.h"

namespace skyig::server::ephemeris::events {
namespace {

using tests::CsvRow;

UtcClockTime utc(std::string_view text) {
    return parse_utc(text).value();
}

TimeSpan around(const UtcClockTime& time, double reach_s) {
    TimeSpan span{time, time};
    span.from.advance(-reach_s);
    span.to.advance(reach_s);
    return span;
}

/// Seconds by which a contact is late against a printed one.
double late_s(const Contact& contact, std::string_view printed) {
    return seconds_between(utc(printed), contact.time);
}

TEST(SolarEclipses, ContactsOf2024AreThePublishedOnes) {
    // EclipseWise for 41.0341 N 83.6523 W; its predicted delta-T is 0.4 s short and its Moon has another
    // radius, so some seconds are left.
    const std::vector<SolarEclipse> eclipses = find_solar_eclipses(
        {utc("2024-01-01T00:00:00Z"), utc("2025-01-01T00:00:00Z")}, {41.0341, -83.6523, 0.0});
    ASSERT_EQ(eclipses.size(), 1U);
    const SolarEclipse& eclipse = eclipses.front();
    ASSERT_EQ(eclipse.kind, SolarEclipseKind::kTotal);
    const std::array late{late_s(eclipse.first, "2024-04-08T17:55:52Z"),
                          late_s(eclipse.second.value(), "2024-04-08T19:10:42Z"),
                          late_s(eclipse.maximum, "2024-04-08T19:12:34Z"),
                          late_s(eclipse.third.value(), "2024-04-08T19:14:27Z"),
                          late_s(eclipse.fourth, "2024-04-08T20:26:37Z")};
    std::printf("2024-04-08: contacts late by %.1f %.1f %.1f %.1f %.1f s, magnitude %.4f\n", late[0], late[1],
                late[2], late[3], late[4], eclipse.magnitude);
    for (const double seconds : late)
        EXPECT_LE(std::abs(seconds), 6.5);
    EXPECT_NEAR(eclipse.obscuration, 1.0, 1e-12);
    EXPECT_NEAR(eclipse.magnitude, 1.054, 0.002);
    EXPECT_NEAR(eclipse.maximum.elevation_deg, 50.3, 0.1);
}

TEST(SolarEclipses, KindsDependOnTheSite) {
    // 2023-10-14: annular in Albuquerque, partial in New York, not in Berlin.
    const TimeSpan span{utc("2023-10-01T00:00:00Z"), utc("2023-11-01T00:00:00Z")};
    const std::vector<SolarEclipse> albuquerque = find_solar_eclipses(span, {35.084, -106.650, 1619.0});
    ASSERT_EQ(albuquerque.size(), 1U);
    EXPECT_EQ(albuquerque.front().kind, SolarEclipseKind::kAnnular);
    EXPECT_NEAR(albuquerque.front().obscuration, 0.897, 0.003);
    EXPECT_NEAR(seconds_between(albuquerque.front().second->time, albuquerque.front().third->time), 288.0,
                6.0);
    const std::vector<SolarEclipse> new_york = find_solar_eclipses(span, {40.713, -74.006, 10.0});
    ASSERT_EQ(new_york.size(), 1U);
    EXPECT_EQ(new_york.front().kind, SolarEclipseKind::kPartial);
    EXPECT_FALSE(new_york.front().second.has_value());
    EXPECT_LT(new_york.front().magnitude, 0.5);
    EXPECT_TRUE(find_solar_eclipses(span, {52.52, 13.41, 30.0}).empty());
}

TEST(SolarEclipses, WhatIsBelowTheHorizonIsNotSeen) {
    // 2021-06-10: greatest before sunrise in New York, which saw the later part of it.
    const std::vector<SolarEclipse> eclipses = find_solar_eclipses(
        {utc("2021-06-01T00:00:00Z"), utc("2021-07-01T00:00:00Z")}, {40.713, -74.006, 10.0});
    ASSERT_EQ(eclipses.size(), 1U);
    const SolarEclipse& eclipse = eclipses.front();
    EXPECT_LT(eclipse.first.elevation_deg, -5.0);
    EXPECT_GT(eclipse.fourth.elevation_deg, 5.0);
    EXPECT_GT(eclipse.seen_obscuration, 0.6);
    EXPECT_LE(eclipse.seen_obscuration, eclipse.obscuration);
}

TEST(SolarEclipses, TotalAtEveryPlaceOfTheCanon) {
    const std::vector<CsvRow> rows = tests::read_csv(SKYIG_REFERENCE "/ephemeris/eclipse_greatest.csv");
    if (rows.empty()) GTEST_SKIP() << "the table eclipse_greatest.csv is not part of this clone";
    double most_late_s = 0.0;
    double most_magnitude = 0.0;
    for (const CsvRow& row : rows) {
        // The canon's place goes with the canon's delta-T: turned to where the Earth is by ours.
        UtcClockTime greatest = utc(row.text("td_iso"));
        greatest.advance(-known_offsets(greatest).tt_minus_utc_s);
        const double ours_s =
            known_offsets(greatest).tt_minus_utc_s - known_offsets(greatest).ut1_minus_utc_s;
        constexpr double kDegreesPerSecond = 360.98564736629 / 86400.0;
        const double turned_deg = (ours_s - row.number("catalog_delta_t_s")) * kDegreesPerSecond;
        const std::vector<SolarEclipse> eclipses = find_solar_eclipses(
            around(greatest, 3600.0), {row.number("lat_deg"), row.number("lon_deg") + turned_deg, 0.0});
        ASSERT_EQ(eclipses.size(), 1U) << row.text("td_iso");
        EXPECT_EQ(eclipses.front().kind, SolarEclipseKind::kTotal) << row.text("td_iso");
        const double late = seconds_between(greatest, eclipses.front().maximum.time);
        tests::raise(most_late_s, late);
        // Where the shadow's axis misses the Earth, the canon counts magnitudes in another way.
        if (std::abs(row.number("gamma")) < 0.997)
            tests::raise(most_magnitude, eclipses.front().magnitude - row.number("magnitude"));
    }
    std::printf("eclipse_greatest: %zu, maximum within %.0f s, magnitude within %.4f\n", rows.size(),
                most_late_s, most_magnitude);
    // Places are rounded to 11 km, and "greatest" is of the shadow's axis, not of the site.
    EXPECT_LE(most_late_s, 60.0);
    EXPECT_LE(most_magnitude, 0.003);
}

TEST(LunarEclipses, ContactsOf2018AreThePublishedOnes) {
    // Five Millennium Canon: gamma 0.1168, umbral magnitude 1.6087, penumbral 2.6792.
    const std::vector<LunarEclipse> eclipses =
        find_lunar_eclipses({utc("2018-07-01T00:00:00Z"), utc("2018-08-01T00:00:00Z")}, {0.0, 50.0, 0.0});
    ASSERT_EQ(eclipses.size(), 1U);
    const LunarEclipse& eclipse = eclipses.front();
    EXPECT_EQ(eclipse.kind, LunarEclipseKind::kTotal);
    const std::array late{late_s(eclipse.penumbra_begins, "2018-07-27T17:14:49Z"),
                          late_s(eclipse.umbra_begins.value(), "2018-07-27T18:24:27Z"),
                          late_s(eclipse.totality_begins.value(), "2018-07-27T19:30:15Z"),
                          late_s(eclipse.maximum, "2018-07-27T20:21:44Z"),
                          late_s(eclipse.totality_ends.value(), "2018-07-27T21:13:12Z"),
                          late_s(eclipse.umbra_ends.value(), "2018-07-27T22:19:00Z"),
                          late_s(eclipse.penumbra_ends, "2018-07-27T23:28:37Z")};
    std::printf("2018-07-27: contacts late by");
    for (const double seconds : late) {
        std::printf(" %.1f", seconds);
        EXPECT_LE(std::abs(seconds), 4.0);
    }
    std::printf(" s, magnitudes %.4f %.4f\n", eclipse.umbral_magnitude, eclipse.penumbral_magnitude);
    EXPECT_NEAR(eclipse.umbral_magnitude, 1.6087, 0.002);
    EXPECT_NEAR(eclipse.penumbral_magnitude, 2.6792, 0.002);
}

TEST(LunarEclipses, KindsAreToldApartAndTheOtherSideSeesNone) {
    // 2023: penumbral on May 5 (umbral magnitude -0.0438), partial on October 28 (0.1234).
    const TimeSpan year{utc("2023-01-01T00:00:00Z"), utc("2024-01-01T00:00:00Z")};
    const std::vector<LunarEclipse> eclipses = find_lunar_eclipses(year, {0.0, 60.0, 0.0});
    ASSERT_EQ(eclipses.size(), 2U);
    EXPECT_EQ(eclipses[0].kind, LunarEclipseKind::kPenumbral);
    EXPECT_NEAR(eclipses[0].umbral_magnitude, -0.0438, 0.003);
    EXPECT_FALSE(eclipses[0].umbra_begins.has_value());
    EXPECT_EQ(eclipses[1].kind, LunarEclipseKind::kPartial);
    EXPECT_NEAR(eclipses[1].umbral_magnitude, 0.1234, 0.003);
    EXPECT_FALSE(eclipses[1].totality_begins.has_value());
    EXPECT_TRUE(find_lunar_eclipses(year, {0.0, -160.0, 0.0}).size() < 2U);
}

}  // namespace
}  // namespace skyig::server::ephemeris::events
