// Civil time, the UTC clock and the way from UTC to TT and UT1, leap seconds and ends of the tables included.
#include "server/ephemeris/time.h"

#include <erfa.h>
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

double difference_s(const JulianDate& later, const JulianDate& earlier) {
    return ((later.day - earlier.day) + (later.fraction - earlier.fraction)) * kSecondsPerDay;
}

double tt_minus_ut1_s(const Instant& instant) {
    return difference_s(instant.tt, instant.ut1);
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

TEST(Instant, IsThatOfErfa) {
    // One instant in every 37.3 days of the leap-second era, and around every day's end that has a leap
    // second.
    double largest_s = 0.0;
    int count = 0;
    const auto compare = [&](const UtcClockTime& time) {
        const CivilTime civil = time.civil();
        constexpr double kDut1_s = 0.25;
        std::array<double, 2> utc{};
        std::array<double, 2> tai{};
        std::array<double, 2> tt{};
        std::array<double, 2> ut1{};
        ASSERT_GE(eraDtf2d("UTC", civil.year, civil.month, civil.day, civil.hour, civil.minute, civil.second,
                           &utc[0], &utc[1]),
                  0);
        ASSERT_GE(eraUtctai(utc[0], utc[1], &tai[0], &tai[1]), 0);
        ASSERT_EQ(eraTaitt(tai[0], tai[1], &tt[0], &tt[1]), 0);
        ASSERT_GE(eraUtcut1(utc[0], utc[1], kDut1_s, &ut1[0], &ut1[1]), 0);
        const Instant instant = make_instant(time, kDut1_s);
        largest_s = std::max({largest_s, std::abs(difference_s(instant.tt, {tt[0], tt[1]})),
                              std::abs(difference_s(instant.ut1, {ut1[0], ut1[1]}))});
        ++count;
    };
    const UtcClockTime end = at("2026-12-31T00:00:00Z");
    for (UtcClockTime time = at("1972-01-01T00:00:00Z"); seconds_between(time, end) > 0.0;) {
        compare(time);
        time.advance(37.3 * kSecondsPerDay);
    }
    for (const std::string_view day : {"1972-06-30", "1998-12-31", "2008-12-31", "2016-12-31"}) {
        UtcClockTime time = at(std::string(day) + "T23:59:58Z");
        for (int step = 0; step < 16; ++step) {
            compare(time);
            time.advance(0.25);
        }
    }
    std::printf("TT and UT1 against ERFA's own chain: %d instants, max %.1e s\n", count, largest_s);
    EXPECT_GT(count, 500);
    EXPECT_LE(largest_s, 1e-6);
}

TEST(Instant, RunsEvenlyThroughTheLeapSecond) {
    constexpr double kStep_s = 0.125;
    UtcClockTime time = at("2016-12-31T23:59:57Z");
    Instant before = make_instant(time);
    double largest_tt_error_s = 0.0;
    double least_ut1_step_s = 1.0;
    double largest_ut1_step_s = 0.0;
    for (int step = 0; step < 64; ++step) {
        time.advance(kStep_s);
        const Instant now = make_instant(time);
        largest_tt_error_s =
            std::max(largest_tt_error_s, std::abs(difference_s(now.tt, before.tt) - kStep_s));
        least_ut1_step_s = std::min(least_ut1_step_s, difference_s(now.ut1, before.ut1));
        largest_ut1_step_s = std::max(largest_ut1_step_s, difference_s(now.ut1, before.ut1));
        before = now;
    }
    EXPECT_EQ(to_iso(time), "2017-01-01T00:00:04Z");
    std::printf("through a leap second: TT step error %.1e s, UT1 steps %.6f..%.6f of %.6f s\n",
                largest_tt_error_s, least_ut1_step_s, largest_ut1_step_s, kStep_s);
    EXPECT_LE(largest_tt_error_s, 1e-9);
    EXPECT_NEAR(least_ut1_step_s, kStep_s, 1e-5);
    EXPECT_NEAR(largest_ut1_step_s, kStep_s, 1e-5);
}

TEST(Instant, HoldsTheLastLeapSecondAndSaysSo) {
    const Instant known = make_instant(at("2020-06-01T00:00:00Z"));
    EXPECT_FALSE(known.leap_seconds_assumed);
    EXPECT_NEAR(tt_minus_ut1_s(known), 69.184, 1e-9);
    const Instant future = make_instant(at("2090-06-01T00:00:00Z"));
    EXPECT_TRUE(future.leap_seconds_assumed);
    EXPECT_FALSE(future.clamped);
    EXPECT_NEAR(tt_minus_ut1_s(future), 69.184, 1e-9);
    EXPECT_FALSE(make_instant(at("1930-06-01T00:00:00Z")).leap_seconds_assumed);
}

TEST(Instant, TakesDut1AsGiven) {
    const UtcClockTime time = at("2016-12-31T23:59:60.5Z");
    EXPECT_NEAR(tt_minus_ut1_s(make_instant(time, -0.408)), 68.184 + 0.408, 1e-9);
    EXPECT_NEAR(tt_minus_ut1_s(make_instant(time, 0.0)), 68.184, 1e-9);
    EXPECT_EQ(make_instant(time, kNan), make_instant(time));
}

TEST(Instant, IsClampedToTwoCenturies) {
    const Instant first = make_instant(at("1900-01-01T00:00:00Z"));
    const Instant last = make_instant(at("2100-12-31T23:59:59Z"));
    EXPECT_FALSE(first.clamped);
    EXPECT_FALSE(last.clamped);
    const Instant early = make_instant(at("1899-12-31T23:59:59Z"));
    const Instant late = make_instant(at("2101-01-01T00:00:00Z"));
    EXPECT_TRUE(early.clamped);
    EXPECT_TRUE(late.clamped);
    EXPECT_EQ(early.tt, first.tt);
    EXPECT_NEAR(difference_s(late.tt, last.tt), 1.0, 1e-9);
    EXPECT_EQ(make_instant(at("9999-12-31T00:00:00Z")).tt, late.tt);
    EXPECT_EQ(make_instant(at("0001-01-01T00:00:00Z")).tt, early.tt);
}

TEST(Instant, DefaultIsThatOfTheDefaultClock) {
    const Instant made = make_instant(UtcClockTime{});
    EXPECT_NEAR(difference_s(made.tt, Instant{}.tt), 0.0, 1e-9);
    EXPECT_NEAR(difference_s(made.ut1, Instant{}.ut1), 0.0, 1e-9);
}

TEST(DeltaT, FollowsTheMeasuredValues) {
    struct Measured {
        double year;
        double delta_t_s;
        double bound_s;
    };
    for (const Measured& row :
         {Measured{1900.0, -1.98, 0.9}, Measured{1910.0, 11.14, 0.9}, Measured{1920.0, 21.62, 0.9},
          Measured{1930.0, 24.42, 0.4}, Measured{1940.0, 24.43, 0.4}, Measured{1950.0, 28.93, 0.15},
          Measured{1960.0, 33.07, 0.15}, Measured{1972.0, 42.23, 0.15}, Measured{1980.0, 50.54, 0.15}}) {
        std::printf("delta-T %.0f: %.2f s, measured %.2f s\n", row.year, delta_t_s(row.year), row.delta_t_s);
        EXPECT_NEAR(delta_t_s(row.year), row.delta_t_s, row.bound_s) << row.year;
    }
    EXPECT_EQ(delta_t_s(1800.0), delta_t_s(1900.0));
    EXPECT_EQ(delta_t_s(2100.0), delta_t_s(1986.0));
}

TEST(DeltaT, JoinsTheLeapSecondsOf1972) {
    const Instant before = make_instant(at("1971-12-31T23:59:59Z"));
    const Instant after = make_instant(at("1972-01-01T00:00:00Z"));
    const double step_s = difference_s(after.tt, before.tt) - 1.0;
    std::printf("TT steps by %.3f s where delta-T gives way to the leap-second table\n", step_s);
    EXPECT_LE(std::abs(step_s), 0.1);
    EXPECT_NEAR(difference_s(after.ut1, before.ut1), 1.0, 1e-9);
}

}  // namespace
}  // namespace skyig::server::ephemeris
