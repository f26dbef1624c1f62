// Civil time, the UTC clock and the way from UTC to TT and UT1, leap seconds and ends of the tables included.
#include "server/ephemeris/time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "tests/server/ephemeris/leap_seconds.h"

namespace skyig::server::ephemeris {
namespace {

constexpr double kSecondsPerDay = 86400.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

UtcClockTime at(std::string_view text) {
    const std::optional<UtcClockTime> time = parse_utc(text);
    EXPECT_TRUE(time.has_value()) << text;
    return time.value_or(UtcClockTime{});
}

TEST(CivilTime, ExistsOrNot) {
    EXPECT_TRUE(is_valid({2000, 2, 29, 0, 0, 0.0}));
    EXPECT_TRUE(is_valid({2024, 2, 29, 23, 59, 59.999}));
    EXPECT_FALSE(is_valid({1900, 2, 29, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({2100, 2, 29, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({2026, 13, 1, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({2026, 0, 1, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({2026, 4, 31, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({2026, 4, 0, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({2026, 4, 1, 24, 0, 0.0}));
    EXPECT_FALSE(is_valid({2026, 4, 1, -1, 0, 0.0}));
    EXPECT_FALSE(is_valid({2026, 4, 1, 0, 60, 0.0}));
    EXPECT_FALSE(is_valid({2026, 4, 1, 0, 0, -0.5}));
    EXPECT_FALSE(is_valid({2026, 4, 1, 0, 0, kNan}));
    EXPECT_FALSE(is_valid({2026, 4, 1, 0, 0, kInfinity}));
    EXPECT_FALSE(is_valid({0, 4, 1, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({10000, 4, 1, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({std::numeric_limits<int>::max(), 1, 1, 0, 0, 0.0}));
    EXPECT_FALSE(is_valid({std::numeric_limits<int>::min(), 1, 1, 0, 0, 0.0}));
}

TEST(CivilTime, SecondSixtyExistsOnLeapDaysOnly) {
    EXPECT_TRUE(is_valid({2016, 12, 31, 23, 59, 60.0}));
    EXPECT_TRUE(is_valid({1972, 6, 30, 23, 59, 60.999}));
    EXPECT_FALSE(is_valid({2016, 12, 31, 23, 59, 61.0}));
    EXPECT_FALSE(is_valid({2016, 12, 31, 23, 58, 60.0}));
    EXPECT_FALSE(is_valid({2016, 12, 30, 23, 59, 60.0}));
    EXPECT_FALSE(is_valid({2026, 12, 31, 23, 59, 60.0}));
    EXPECT_FALSE(is_valid({1971, 12, 31, 23, 59, 60.0}));
    EXPECT_FALSE(is_valid({1965, 12, 31, 23, 59, 60.0}));
}

TEST(UtcClockTime, ComesBackAsTheSameCivilTime) {
    for (const CivilTime& civil :
         {CivilTime{1, 1, 1, 0, 0, 0.0}, CivilTime{1900, 1, 1, 0, 0, 0.0}, CivilTime{1970, 1, 1, 0, 0, 0.5},
          CivilTime{2000, 2, 29, 12, 34, 56.75}, CivilTime{2016, 12, 31, 23, 59, 60.5},
          CivilTime{2038, 1, 19, 3, 14, 8.0}, CivilTime{2100, 12, 31, 23, 59, 59.5},
          CivilTime{9999, 12, 31, 23, 59, 59.0}}) {
        const std::optional<UtcClockTime> time = UtcClockTime::from_civil(civil);
        ASSERT_TRUE(time.has_value());
        EXPECT_EQ(time->civil(), civil) << to_iso(*time, 3);
    }
}

TEST(UtcClockTime, EveryDayOfTwoCenturiesFollowsTheOther) {
    UtcClockTime time = at("1899-12-31T12:00:00Z");
    int leap_days = 0;
    int long_days = 0;
    for (std::int32_t mjd = 15020; mjd <= 88433; ++mjd) {
        const UtcClockTime before = time;
        time.advance(kSecondsPerDay);
        // After a day of 86401 seconds the same time of day comes a second later.
        if (time.second_of_day() != 43200.0) {
            ++long_days;
            EXPECT_EQ(time.second_of_day(), 43199.0) << to_iso(time);
            time.advance(1.0);
        }
        ASSERT_EQ(time.mjd(), mjd);
        ASSERT_GE(seconds_between(before, time), kSecondsPerDay);
        const CivilTime civil = time.civil();
        ASSERT_TRUE(is_valid(civil)) << to_iso(time);
        ASSERT_EQ(UtcClockTime::from_civil(civil), time);
        if (civil.month == 2 && civil.day == 29) ++leap_days;
    }
    EXPECT_EQ(to_iso(time), "2100-12-31T12:00:00Z");
    // Every fourth year but 1900 and 2100; 2000 is one.
    EXPECT_EQ(leap_days, 49);
    EXPECT_EQ(long_days, 27);
}

TEST(UtcClockTime, StaysWithinItsDayAtTheLastMoment) {
    const double last = std::nextafter(60.0, 0.0);
    const std::optional<UtcClockTime> time = UtcClockTime::from_civil({2026, 6, 21, 23, 59, last});
    ASSERT_TRUE(time.has_value());
    EXPECT_LT(time->second_of_day(), kSecondsPerDay);
    EXPECT_EQ(time->civil().day, 21);
}

TEST(UtcClockTime, ReadsUnixTime) {
    EXPECT_EQ(UtcClockTime::from_unix(0), at("1970-01-01T00:00:00Z"));
    EXPECT_EQ(UtcClockTime::from_unix(1483228800), at("2017-01-01T00:00:00Z"));
    EXPECT_EQ(UtcClockTime::from_unix(2147483648, 500'000'000), at("2038-01-19T03:14:08.5Z"));
    EXPECT_EQ(UtcClockTime::from_unix(-1), at("1969-12-31T23:59:59Z"));
    const UtcClockTime garbage = UtcClockTime::from_unix(std::numeric_limits<std::int64_t>::min(), -5);
    EXPECT_EQ(garbage.civil().year, 1);
}

TEST(UtcClockTime, CountsTheLeapSecond) {
    UtcClockTime time = at("2016-12-31T23:59:59.5Z");
    time.advance(1.0);
    EXPECT_EQ(to_iso(time, 1), "2016-12-31T23:59:60.5Z");
    time.advance(1.0);
    EXPECT_EQ(to_iso(time, 1), "2017-01-01T00:00:00.5Z");
    time.advance(-1.0);
    EXPECT_EQ(to_iso(time, 1), "2016-12-31T23:59:60.5Z");
    time.advance(-1.0);
    EXPECT_EQ(to_iso(time, 1), "2016-12-31T23:59:59.5Z");
    EXPECT_EQ(seconds_between(at("2016-12-31T00:00:00Z"), at("2017-01-01T00:00:00Z")), 86401.0);
    EXPECT_EQ(seconds_between(at("2017-01-02T00:00:00Z"), at("2017-01-01T00:00:00Z")), -86400.0);
}

TEST(UtcClockTime, RollsOverTheYear) {
    UtcClockTime time = at("2025-12-31T23:59:59.75Z");
    time.advance(0.5);
    EXPECT_EQ(to_iso(time, 2), "2026-01-01T00:00:00.25Z");
    time.advance(-0.5);
    EXPECT_EQ(to_iso(time, 2), "2025-12-31T23:59:59.75Z");
}

TEST(UtcClockTime, AdvancesByAsMuchAsLiesBetween) {
    constexpr std::array kSteps_s{0.016, 1.0, 59.0, 86400.0, 86401.0, 1e6, 3.2e7, 1.6e9, 6e9};
    for (const std::string_view start :
         {"1900-01-01T00:00:00Z", "1971-12-31T23:59:59Z", "1972-06-30T23:59:60Z", "2005-12-31T23:59:60.25Z",
          "2026-06-21T12:00:00Z"}) {
        for (const double step_s : kSteps_s) {
            for (const double signed_step_s : {step_s, -step_s}) {
                UtcClockTime time = at(start);
                time.advance(signed_step_s);
                EXPECT_NEAR(seconds_between(at(start), time), signed_step_s, 2e-6)
                    << start << ' ' << signed_step_s;
                time.advance(-signed_step_s);
                EXPECT_NEAR(seconds_between(at(start), time), 0.0, 2e-6) << start << ' ' << signed_step_s;
            }
        }
    }
}

TEST(UtcClockTime, KeepsAnHourOfFramesToAMicrosecond) {
    UtcClockTime time = at("2016-12-31T23:30:00Z");
    constexpr int kFrames = 60 * 3600;
    for (int frame = 0; frame < kFrames; ++frame)
        time.advance(1.0 / 60.0);
    const double drift_s = seconds_between(at("2016-12-31T23:30:00Z"), time) - 3600.0;
    std::printf("an hour of sixtieths drifts by %.2e s\n", drift_s);
    EXPECT_LE(std::abs(drift_s), 1e-6);
    EXPECT_EQ(to_iso(time).substr(0, 17), "2017-01-01T00:29:");
}

TEST(UtcClockTime, SurvivesGarbage) {
    UtcClockTime time = at("2026-06-21T12:00:00Z");
    time.advance(kNan);
    time.advance(kInfinity);
    time.advance(-kInfinity);
    EXPECT_EQ(time, at("2026-06-21T12:00:00Z"));
    time.advance(1e300);
    EXPECT_EQ(time.civil().year, 9999);
    EXPECT_TRUE(is_valid(time.civil()));
    time.advance(-1e300);
    EXPECT_EQ(time.civil().year, 1);
    EXPECT_TRUE(is_valid(time.civil()));
}

TEST(UtcText, SecondSixtyIsReadOnEveryDayThatHasOne) {
    for (const std::string_view day : tests::kLeapSecondDays) {
        const std::string text = std::string(day) + "T23:59:60.999Z";
        const std::optional<UtcClockTime> time = parse_utc(text);
        ASSERT_TRUE(time.has_value()) << text;
        EXPECT_EQ(to_iso(*time, 3), text);
        EXPECT_NEAR(time->second_of_day(), 86400.999, 1e-9);
        EXPECT_FALSE(parse_utc(std::string(day) + "T23:59:61Z").has_value()) << day;
    }
}

TEST(UtcText, ReadsWhatPeopleWrite) {
    EXPECT_EQ(to_iso(at("2026-06-21T19:30:00Z")), "2026-06-21T19:30:00Z");
    EXPECT_EQ(to_iso(at("2026-06-21T19:30Z")), "2026-06-21T19:30:00Z");
    EXPECT_EQ(to_iso(at("2026-06-21 19:30")), "2026-06-21T19:30:00Z");
    EXPECT_EQ(to_iso(at("2026-06-21T19:30:07.25Z"), 3), "2026-06-21T19:30:07.250Z");
    EXPECT_EQ(to_iso(at("2026-06-21T23:59:59.1Z"), 1), "2026-06-21T23:59:59.1Z");
    EXPECT_EQ(to_iso(at("2026-06-21T23:59:59.99999999999999999999Z")).substr(0, 10), "2026-06-22");
    EXPECT_EQ(to_iso(at("2016-12-31T23:59:60Z")), "2016-12-31T23:59:60Z");
    EXPECT_EQ(to_iso(at("0001-01-01T00:00:00Z")), "0001-01-01T00:00:00Z");
}

TEST(UtcText, RefusesWhatIsNoTime) {
    for (const std::string_view text : {"",
                                        "now",
                                        "2026",
                                        "2026-06-21",
                                        "2026-06-21T",
                                        "2026-6-21T19:30Z",
                                        "2026-06-21T19:30:00+02:00",
                                        "2026-06-21T19:30:Z",
                                        "2026-06-21T19:30:5Z",
                                        "2026-06-21T19:30:00.Z",
                                        "2026-06-21T19:30:00Zx",
                                        " 2026-06-21T19:30Z",
                                        "2026-02-29T00:00Z",
                                        "2026-06-21T24:00Z",
                                        "2026-06-21T23:59:60Z",
                                        "-026-06-21T19:30Z",
                                        "2026-06-21T19:30:-1Z",
                                        "2026-06-21T+9:30Z",
                                        "2026-06-21T19:30:00ZZ",
                                        "26-06-21T19:30Z"}) {
        EXPECT_FALSE(parse_utc(text).has_value()) << text;
    }
}

}  // namespace
}  // namespace skyig::server::ephemeris
