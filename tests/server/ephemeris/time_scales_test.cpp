// TT, UT1 and the scales beside them, as make_instant() gives them.
#include <erfa.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/ephemeris/delta_t.h"
#include "server/ephemeris/time.h"
#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/leap_seconds.h"
#include "tests/server/ephemeris/truth.h"

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

/// Walks the clock and looks at each step of TT and UT1 beside the clock's own.
class StepWatch {
  public:
    explicit StepWatch(const UtcClockTime& start) : time_(start), instant_(make_instant(start)) {}

    void advance(double step_s) {
        time_.advance(step_s);
        const Instant now = make_instant(time_);
        const double tt_step_s = difference_s(now.tt, instant_.tt);
        const double ut1_step_s = difference_s(now.ut1, instant_.ut1);
        backwards_ += tt_step_s > 0.0 && ut1_step_s > 0.0 ? 0 : 1;
        tests::raise(tt_error_s_, tt_step_s - step_s);
        tests::raise(ut1_error_s_, ut1_step_s - step_s);
        instant_ = now;
    }

    [[nodiscard]] const UtcClockTime& time() const { return time_; }
    /// Steps in which TT or UT1 did not run forwards.
    [[nodiscard]] int backwards() const { return backwards_; }
    [[nodiscard]] double tt_error_s() const { return tt_error_s_; }
    [[nodiscard]] double ut1_error_s() const { return ut1_error_s_; }

  private:
    UtcClockTime time_;
    Instant instant_;
    int backwards_ = 0;
    double tt_error_s_ = 0.0;
    double ut1_error_s_ = 0.0;
};

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
        tests::raise(largest_s, difference_s(instant.tt, {tt[0], tt[1]}));
        tests::raise(largest_s, difference_s(instant.ut1, {ut1[0], ut1[1]}));
        tests::raise(largest_s, difference_s(tai_from_tt(instant.tt), {tai[0], tai[1]}));
        ++count;
    };
    const UtcClockTime end = at("2026-12-31T00:00:00Z");
    for (UtcClockTime time = at("1972-01-01T00:00:00Z"); seconds_between(time, end) > 0.0;) {
        compare(time);
        time.advance(37.3 * kSecondsPerDay);
    }
    for (const std::string_view day : tests::kLeapSecondDays) {
        UtcClockTime time = at(std::string(day) + "T23:59:58Z");
        for (int step = 0; step < 16; ++step) {
            compare(time);
            time.advance(0.25);
        }
    }
    std::printf("TAI, TT and UT1 against ERFA's own chain: %d instants, max %.1e s\n", count, largest_s);
    EXPECT_GT(count, 900);
    EXPECT_LE(largest_s, 1e-6);
}

TEST(Instant, RunsForwardsThroughEverySeam) {
    // Ends of days with a leap second, year starts (knots of the table), where UT1 becomes UTC and leap
    // seconds begin, where the table ends, and dates that others fall over.
    std::vector<UtcClockTime> seams;
    for (const std::string_view day : tests::kLeapSecondDays)
        seams.push_back(at(std::string(day) + "T23:59:59Z"));
    for (int year = 1900; year <= 2100; ++year)
        seams.push_back(UtcClockTime::from_civil({year, 1, 1, 0, 0, 0.0}).value());
    for (const std::string_view text :
         {"1970-12-31T23:59:59Z", "1971-12-31T23:59:59Z", "2026-12-31T23:59:59Z", "2038-01-19T03:14:07Z",
          "1900-02-28T23:59:59Z", "2000-02-29T00:00:00Z", "2100-02-28T23:59:59Z"})
        seams.push_back(at(text));

    int backwards = 0;
    double tt_error_s = 0.0;
    double ut1_error_s = 0.0;
    for (UtcClockTime seam : seams) {
        if (seam.mjd() > 15020) seam.advance(-1.0);
        StepWatch watch(seam);
        for (int step = 0; step < 4000; ++step)
            watch.advance(0.001);
        backwards += watch.backwards();
        tests::raise(tt_error_s, watch.tt_error_s());
        tests::raise(ut1_error_s, watch.ut1_error_s());
    }
    std::printf("%zu seams in steps of 1 ms: step errors TT %.1e s, UT1 %.1e s\n", seams.size(), tt_error_s,
                ut1_error_s);
    EXPECT_EQ(backwards, 0);
    EXPECT_LE(tt_error_s, 1e-9);
    EXPECT_LE(ut1_error_s, 1e-9);
}

TEST(Instant, RunsForwardsThroughTwoCenturies) {
    StepWatch watch(at("1900-01-01T00:00:00Z"));
    constexpr double kStep_s = 7000.0;
    while (seconds_between(watch.time(), at("2100-12-31T23:00:00Z")) > kStep_s)
        watch.advance(kStep_s);
    std::printf("1900..2100 in steps of 7000 s: TT within %.1e s, UT1 within %.1e s of the clock's step\n",
                watch.tt_error_s(), watch.ut1_error_s());
    EXPECT_EQ(watch.backwards(), 0);
    // Delta-T moves by up to 1.7 s a year, 4e-4 s in a step.
    EXPECT_LE(watch.tt_error_s(), 5e-4);
    EXPECT_LE(watch.ut1_error_s(), 5e-4);
}

TEST(Instant, IsThatOfEveryTruthRowWithItsOffsets) {
    const std::vector<tests::CsvRow> rows = tests::read_csv(SKYIG_TEST_DATA "/ephemeris/topo_truth.csv");
    ASSERT_FALSE(rows.empty());
    double largest_s = 0.0;
    int leap_seconds = 0;
    for (const tests::CsvRow& row : rows) {
        const std::string text = row.text("utc");
        const double tt_minus_utc_s = row.number("tt_minus_utc_s");
        const double ut1_minus_utc_s = row.number("ut1_minus_utc_s");
        const Instant expected = tests::instant_of(text, tt_minus_utc_s, ut1_minus_utc_s);
        const Instant instant =
            make_instant(at(text), {.tt_minus_utc_s = tt_minus_utc_s, .ut1_minus_utc_s = ut1_minus_utc_s});
        tests::raise(largest_s, difference_s(instant.tt, expected.tt));
        tests::raise(largest_s, difference_s(instant.ut1, expected.ut1));
        EXPECT_FALSE(instant.leap_seconds_assumed) << text;
        leap_seconds += text.find(":60") != std::string::npos ? 1 : 0;
    }
    std::printf("%zu rows with their own offsets, %d in a leap second: max %.1e s\n", rows.size(),
                leap_seconds, largest_s);
    EXPECT_GT(leap_seconds, 20);
    EXPECT_LE(largest_s, 1e-9);
}

TEST(Instant, HoldsTheLastLeapSecondAndSaysSo) {
    const Instant known = make_instant(at("2020-06-01T00:00:00Z"));
    EXPECT_FALSE(known.leap_seconds_assumed);
    const Instant future = make_instant(at("2090-06-01T00:00:00Z"));
    EXPECT_TRUE(future.leap_seconds_assumed);
    EXPECT_FALSE(future.clamped);
    EXPECT_NEAR(difference_s(future.tt, tests::instant_of("2090-06-01T00:00:00", 69.184, 0.0).tt), 0.0, 1e-9);
    EXPECT_NEAR(tt_minus_ut1_s(future), 69.184, 1e-9);
    EXPECT_EQ(known_offsets(at("2090-06-01T00:00:00Z")).ut1_minus_utc_s, 0.0);
    EXPECT_FALSE(make_instant(at("1930-06-01T00:00:00Z")).leap_seconds_assumed);
    EXPECT_FALSE(make_instant(at("2090-06-01T00:00:00Z"), {.tt_minus_utc_s = 70.184}).leap_seconds_assumed);
}

TEST(Instant, TakesOffsetsAsGivenEachForItself) {
    const UtcClockTime time = at("2016-12-31T23:59:60.5Z");
    const Instant known = make_instant(time);
    EXPECT_NEAR(tt_minus_ut1_s(make_instant(time, -0.408)), 68.184 + 0.408, 1e-9);
    EXPECT_NEAR(tt_minus_ut1_s(make_instant(time, 0.0)), 68.184, 1e-9);
    const Instant later = make_instant(time, {.tt_minus_utc_s = 100.0});
    EXPECT_NEAR(difference_s(later.tt, known.tt), 100.0 - 68.184, 1e-9);
    EXPECT_EQ(later.ut1, known.ut1);
    const Instant poles = make_instant(time, {.polar_x_rad = 1e-6, .polar_y_rad = -2e-6});
    EXPECT_EQ(poles.polar_x_rad, 1e-6);
    EXPECT_EQ(poles.polar_y_rad, -2e-6);
    EXPECT_EQ(poles.tt, known.tt);
    EXPECT_EQ(poles.ut1, known.ut1);
    // Before 1971 the clock is UT1, and offsets are what the row says all the same.
    const Instant early = make_instant(at("1925-06-15T03:30:00Z"), {.tt_minus_utc_s = 24.0});
    EXPECT_NEAR(tt_minus_ut1_s(early), 24.0, 1e-9);
    EXPECT_EQ(early.ut1, make_instant(at("1925-06-15T03:30:00Z")).ut1);
}

TEST(Instant, GarbageOffsetsAreNone) {
    const UtcClockTime time = at("2026-06-21T12:00:00Z");
    const Instant known = make_instant(time);
    for (const double garbage : {kNan, kInfinity, -kInfinity, 1e300, -1e300, 3601.0}) {
        EXPECT_EQ(make_instant(time, garbage), known) << garbage;
        EXPECT_EQ(make_instant(time, {garbage, garbage, garbage, garbage}), known) << garbage;
    }
    EXPECT_NE(make_instant(time, 3600.0).ut1, known.ut1);
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
    EXPECT_NEAR(difference_s(made.ut1, Instant{}.ut1), 0.0, 0.01);
}

TEST(DynamicalTime, FollowsErfasSeries) {
    double largest_s = 0.0;
    double largest_offset_s = 0.0;
    constexpr double kFirst = 2415020.5;
    constexpr double kLast = 2488433.5;
    for (double day = kFirst; day < kLast; day += 9.7) {
        const JulianDate tt{day, 0.25};
        const double truth_s = eraDtdb(tt.day, tt.fraction, 0.0, 0.0, 0.0, 0.0);
        tests::raise(largest_s, tdb_minus_tt_s(tt) - truth_s);
        tests::raise(largest_offset_s, difference_s(tdb_from_tt(tt), tt));
    }
    std::printf("TDB - TT: up to %.6f s, error %.1e s\n", largest_offset_s, largest_s);
    EXPECT_LE(largest_s, 5.5e-5);
    EXPECT_NEAR(largest_offset_s, 0.001657, 1e-5);
}

TEST(DeltaT, FollowsTheMeasuredValues) {
    struct Measured {
        double year;
        double delta_t_s;
    };
    double largest_s = 0.0;
    for (const Measured& row :
         {Measured{1900.0, -1.98}, Measured{1910.0, 11.14}, Measured{1920.0, 21.62}, Measured{1930.0, 24.42},
          Measured{1940.0, 24.43}, Measured{1950.0, 28.93}, Measured{1960.0, 33.07}, Measured{1972.0, 42.23},
          Measured{1980.0, 50.54}, Measured{1990.0, 56.86}, Measured{2000.0, 63.83}, Measured{2010.0, 66.07},
          Measured{2015.0, 67.64}, Measured{2018.0, 68.97}, Measured{2022.0, 69.29}}) {
        tests::raise(largest_s, delta_t_s(row.year) - row.delta_t_s);
        // Between the knots too: half-way the measured values lie within what a year can do.
        EXPECT_NEAR(delta_t_s(row.year + 0.5), 0.5 * (delta_t_s(row.year) + delta_t_s(row.year + 1.0)), 0.1);
    }
    std::printf("delta-T against 15 measured values: max %.3f s\n", largest_s);
    EXPECT_LE(largest_s, 0.0051);
}

TEST(DeltaT, IsHeldOutsideTheTableAndAlwaysFinite) {
    EXPECT_EQ(delta_t_s(1800.0), delta_t_s(1900.0));
    EXPECT_EQ(delta_t_s(-kInfinity), delta_t_s(1900.0));
    EXPECT_EQ(delta_t_s(2027.0), kHeldDeltaT_s);
    EXPECT_EQ(delta_t_s(2100.0), kHeldDeltaT_s);
    EXPECT_EQ(delta_t_s(kInfinity), kHeldDeltaT_s);
    EXPECT_EQ(delta_t_s(kNan), kHeldDeltaT_s);
    EXPECT_NEAR(delta_t_s(std::nextafter(2027.0, 0.0)), kHeldDeltaT_s, 1e-9);
}

TEST(DeltaT, NeverStepsAndNeverOutrunsTheClock) {
    constexpr double kSecondsPerYear = 365.25 * kSecondsPerDay;
    constexpr double kStep_years = 1.0 / 4096.0;
    double steepest = 0.0;
    for (double year = 1899.0; year < 2101.0; year += kStep_years) {
        tests::raise(steepest, std::abs(delta_t_s(year + kStep_years) - delta_t_s(year)) /
                                   (kStep_years * kSecondsPerYear));
    }
    std::printf("delta-T moves by at most %.1e s in a second\n", steepest);
    EXPECT_LE(steepest, 1e-7);
}

TEST(DeltaT, FollowsTheDailyValuesOfHorizons) {
    tests::ErrorStatistics early;
    tests::ErrorStatistics measured;
    for (const char* file : {"/ephemeris/horizons_topo.csv", "/ephemeris/horizons_airless.csv"}) {
        for (const tests::CsvRow& row : tests::read_csv(std::string(SKYIG_REFERENCE) + file)) {
            const std::string date = row.text("date_ut");
            // Their later values are a prediction of 2019.
            if (date > "2019-06") continue;
            const double truth_s = row.number("tt_minus_ut_s") - row.number("ut1_minus_ut_s");
            const Instant instant = make_instant(at(date));
            (date < "1972" ? early : measured).add(tt_minus_ut1_s(instant) - truth_s);
        }
    }
    if (early.count == 0) GTEST_SKIP() << "the Horizons tables are not here";
    std::printf(
        "delta-T against Horizons: to 1961 max %.3f s, rms %.3f s (%zu); from 1972 max %.3f s, rms "
        "%.3f s (%zu)\n",
        early.max, early.rms(), early.count, measured.max, measured.rms(), measured.count);
    EXPECT_GT(measured.count, 500U);
    EXPECT_LE(early.max, 0.02);
    EXPECT_LE(measured.max, 0.035);
}

TEST(OffsetsOfDay, AreTheKnownOffsetsWhateverWayTheClockRuns) {
    OffsetsOfDay offsets;
    const auto expect_same = [&offsets](const UtcClockTime& time) {
        const KnownOffsets known = known_offsets(time);
        const KnownOffsets kept = offsets.at(time);
        EXPECT_EQ(kept.tt_minus_utc_s, known.tt_minus_utc_s) << to_iso(time, 3);
        EXPECT_EQ(kept.ut1_minus_utc_s, known.ut1_minus_utc_s) << to_iso(time, 3);
        EXPECT_EQ(kept.leap_seconds_assumed, known.leap_seconds_assumed) << to_iso(time, 3);
        EXPECT_EQ(make_instant(time, kept, {}), make_instant(time));
    };
    // Through leap seconds and year ends there and back, and from one to the next without going there.
    for (const char* text :
         {"1971-12-31T23:59:58Z", "1972-06-30T23:59:58Z", "2016-12-31T23:59:58Z", "1970-12-31T23:59:58Z",
          "2000-02-28T23:59:58Z", "2100-12-31T23:59:58Z", "1858-11-17T00:00:00Z", "1900-01-01T00:00:02Z"}) {
        UtcClockTime time = at(text);
        for (const double step_s : {0.25, -0.25}) {
            for (int step = 0; step < 20; ++step) {
                expect_same(time);
                time.advance(step_s);
            }
        }
    }
    for (int year = 9999; year > 1; year -= 13)
        expect_same(UtcClockTime::from_civil({.year = year}).value());
}

}  // namespace
}  // namespace skyig::server::ephemeris
