// Moments of rows: exact Julian dates, offsets that come before the tables, leap seconds, TT.
#include "clients/row_time.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skyig::clients {
namespace {

using server::ephemeris::Instant;
using server::ephemeris::JulianDate;

constexpr double kSecondsPerDay = 86400.0;

double seconds_of(const JulianDate& date, double jd) {
    return ((date.day - jd) + date.fraction) * kSecondsPerDay;
}

TEST(RowTime, JulianDatesKeepAllDigits) {
    const JulianDate date = parse_julian_date("2460409.26250000000001").value();
    EXPECT_EQ(date.day, 2460409.0);
    EXPECT_EQ(date.fraction, 0.26250000000001);
    EXPECT_EQ(parse_julian_date("2451545").value(), (JulianDate{2451545.0, 0.0}));
    EXPECT_EQ(parse_julian_date("2451545.").value(), (JulianDate{2451545.0, 0.0}));
    EXPECT_EQ(parse_julian_date("2.4515455e6").value(), (JulianDate{2451545.0, 0.5}));
    for (const char* text : {"", "noon", "2451545.5x", "2451545,5", "24515.45.5", "nan"})
        EXPECT_FALSE(parse_julian_date(text).has_value()) << text;
}

TEST(RowTime, OffsetsComeBeforeTheTables) {
    const Instant instant =
        parse_row_time("2010-03-04T12:00:00Z", TimeForm::kUtc, {100.0, -50.0, {}}).value();
    EXPECT_NEAR(seconds_of(instant.tt, 2455259.5), 43300.0, 1e-6);
    EXPECT_NEAR(seconds_of(instant.ut1, 2455259.5), 43150.0, 1e-6);
    const Instant tables = parse_row_time("2010-03-04T12:00:00Z", TimeForm::kUtc, {}).value();
    EXPECT_NEAR(seconds_of(tables.tt, 2455259.5), 43200.0 + 66.184, 1e-6);
}

TEST(RowTime, FormsOfUtcAreOneAndTheSame) {
    const Instant instant = parse_row_time("2010-03-04T12:00:00Z", TimeForm::kUtc, {}).value();
    for (const char* text : {"2010-03-04 12:00:00", "2010-03-04T12:00:00.000", "2010-03-04T12:00Z"})
        EXPECT_EQ(parse_row_time(text, TimeForm::kUtc, {}).value(), instant) << text;
    for (const char* text :
         {"2010-03-04", "2010-02-30T12:00:00Z", "2010-03-04T24:00:00Z", "04.03.2010 12:00"})
        EXPECT_FALSE(parse_row_time(text, TimeForm::kUtc, {}).has_value()) << text;
}

TEST(RowTime, LeapSecondsCountFromMidnightWithTheOffsetsBeforeThem) {
    const Instant instant =
        parse_row_time("2016-12-31T23:59:60.500Z", TimeForm::kUtc, {68.184, -0.408, {}}).value();
    EXPECT_NEAR(seconds_of(instant.tt, 2457753.5), 86400.5 + 68.184, 1e-6);
    EXPECT_NEAR(seconds_of(instant.ut1, 2457753.5), 86400.5 - 0.408, 1e-6);
    EXPECT_FALSE(parse_row_time("2015-12-31T23:59:60Z", TimeForm::kUtc, {}).has_value());
}

TEST(RowTime, TtIsTakenAsItStands) {
    const Instant given = parse_row_time("1901-05-18T05:33:48.0", TimeForm::kTtCivil, {{}, {}, -1.0}).value();
    EXPECT_NEAR(seconds_of(given.tt, 2415522.5), 5 * 3600.0 + 33 * 60.0 + 48.0, 1e-6);
    EXPECT_NEAR(seconds_of(given.ut1, 2415522.5), 5 * 3600.0 + 33 * 60.0 + 49.0, 1e-6);
    // From the tables: the lag that the clock's UTC has then.
    const Instant tables = parse_row_time("2010-03-04T12:01:06.184", TimeForm::kTtCivil, {}).value();
    const Instant utc = parse_row_time("2010-03-04T12:00:00", TimeForm::kUtc, {}).value();
    EXPECT_NEAR(seconds_of(tables.tt, utc.tt.day + utc.tt.fraction), 0.0, 1e-4);
    EXPECT_NEAR(seconds_of(tables.ut1, utc.ut1.day + utc.ut1.fraction), 0.0, 1e-4);
}

TEST(RowTime, YearsAreThoseTheTheoriesKnow) {
    EXPECT_TRUE(is_in_years({2415020.0, 0.5}));
    EXPECT_TRUE(is_in_years({2488434.0, 0.49}));
    EXPECT_FALSE(is_in_years({2415019.0, 0.5}));
    EXPECT_FALSE(is_in_years({2488435.0, 0.5}));
    EXPECT_FALSE(is_in_years({std::nan(""), 0.5}));
}

}  // namespace
}  // namespace skyig::clients
