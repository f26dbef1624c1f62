// The running clock: midnight, leap seconds, drift, wishes of an operator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/canaerospace/bus_clock.h"
#include "tests/protocol/canaerospace/frames.h"

namespace skyig::protocol::canaerospace {
namespace {

constexpr std::int64_t kDate = 19'895;  // 2024-06-21
constexpr double kBeforeMidnight = 86'399.0;

std::int64_t ns(double seconds) {
    return kStart + static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

/// Seconds since the midnight that began kDate.
double shown(const BusClock& clock, double at_s) {
    const std::optional<BusTime> time = clock.at(ns(at_s));
    if (!time) return std::nan("");
    return static_cast<double>(time->day - kDate) * 86'400.0 + time->second_of_day;
}

TEST(BusClockTest, SaysNothingBeforeBothHaveCome) {
    BusClock clock;
    EXPECT_FALSE(clock.at(ns(0)));
    clock.set_time_of_day(3600.0, 1.0, ns(0));
    EXPECT_FALSE(clock.at(ns(0)));
    clock.set_date(kDate, ns(0.1));
    EXPECT_NEAR(shown(clock, 0.1), 3600.1, 1e-6);
    BusClock other;
    other.set_date(kDate, ns(0));
    EXPECT_FALSE(other.at(ns(0)));
    other.set_time_of_day(3600.0, 1.0, ns(0.5));
    EXPECT_NEAR(shown(other, 1.0), 3600.5, 1e-6);
}

/// Time and date each second, the date `date_after_s` after (or before) the time; how far the clock ever is
/// from the true time, and whether it ever ran backwards or jumped.
double worst_over_midnight(double date_after_s) {
    BusClock clock;
    const double start_s = kBeforeMidnight - 100.0;
    clock.set_time_of_day(start_s, 1.0, ns(0));
    clock.set_date(kDate, ns(0));
    double worst_s = 0.0;
    double before_s = shown(clock, 0.0);
    for (int second = 1; second < 200; ++second) {
        const double true_s = start_s + second;
        const auto send_time = [&] {
            clock.set_time_of_day(std::fmod(true_s, 86'400.0), 1.0,
                                  ns(second + std::max(0.0, -date_after_s)));
        };
        const auto send_date = [&] {
            clock.set_date(kDate + (true_s >= 86'400.0 ? 1 : 0), ns(second + std::max(0.0, date_after_s)));
        };
        if (date_after_s < 0.0) send_date();
        send_time();
        if (date_after_s >= 0.0) send_date();
        for (double t = second + 0.5; t < second + 0.99; t += 0.1) {
            const double now_s = shown(clock, t);
            worst_s = std::max(worst_s, std::abs(now_s - (start_s + t)));
            EXPECT_GE(now_s, before_s);
            before_s = now_s;
        }
    }
    EXPECT_EQ(clock.steps(), 2U);  // the first time and the first date
    return worst_s;
}

TEST(BusClockTest, MidnightNeverJumpsInEitherOrder) {
    for (const double date_after_s : {0.0, 0.02, 0.4, -0.02, -0.4}) {
        const double worst_s = worst_over_midnight(date_after_s);
        std::printf("date %+.2f s after the time: clock within %.3f s over midnight\n", date_after_s,
                    worst_s);
        EXPECT_LT(worst_s, 0.5);
    }
}

TEST(BusClockTest, PassesMidnightWithoutAnyFrame) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    clock.set_time_of_day(kBeforeMidnight, 1.0, ns(0));
    EXPECT_NEAR(shown(clock, 2.5), 86'401.5, 1e-6);
    EXPECT_EQ(clock.at(ns(2.5))->day, kDate + 1);
    EXPECT_NEAR(shown(clock, 10.0 * 86'400.0), kBeforeMidnight + 10.0 * 86'400.0, 1e-3);
}

TEST(BusClockTest, ADateThatIsNeverMovedOnDoesNotPullTheClockBack) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    clock.set_time_of_day(86'200.0, 1.0, ns(0));
    for (int second = 1; second < 60'000; ++second) {
        clock.set_time_of_day(std::fmod(86'200.0 + second, 86'400.0), 1.0, ns(second));
        clock.set_date(kDate, ns(second + 0.1));
    }
    EXPECT_NEAR(shown(clock, 60'000), 86'200.0 + 60'000, 0.01);
}

TEST(BusClockTest, AFirstDateOfTheWrongSideOfMidnightIsMended) {
    BusClock clock;
    clock.set_time_of_day(86'399.0, 1.0, ns(0));
    clock.set_date(kDate + 1, ns(0.2));  // already the new day, the time frame not yet
    for (int second = 1; second < 120; ++second) {
        clock.set_time_of_day(second - 1.0, 1.0, ns(second));
        clock.set_date(kDate + 1, ns(second + 0.2));
    }
    EXPECT_NEAR(shown(clock, 120), 86'400.0 + 119.0, 0.01);
}

TEST(BusClockTest, TakesADateFromAnOperator) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    clock.set_time_of_day(64'800.0, 1.0, ns(0));  // 18 h
    clock.set_date(kDate + 180, ns(1.0));
    EXPECT_NEAR(shown(clock, 1.0), 64'801.0 + 180 * 86'400.0, 1e-3);
    // The next day at 18 h is less than 12 h away: believed once it is repeated for ten seconds.
    for (int second = 2; second < 12; ++second) {
        clock.set_date(kDate + 181, ns(second));
        EXPECT_EQ(clock.at(ns(second))->day, kDate + 180) << second;
    }
    clock.set_date(kDate + 181, ns(12));
    EXPECT_EQ(clock.at(ns(12))->day, kDate + 181);
}

TEST(BusClockTest, AnOperatorsTimeKeepsTheDateSent) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    clock.set_time_of_day(72'000.0, 1.0, ns(0));
    clock.set_time_of_day(21'600.0, 1.0, ns(1));  // 20 h -> 6 h of the same day
    EXPECT_NEAR(shown(clock, 1), 21'600.0, 1e-6);
    clock.set_time_of_day(21'601.0, 1.0, ns(2));
    EXPECT_EQ(clock.steps(), 2U);
}

TEST(BusClockTest, FindsTheSendersSecondAndFollowsItsDrift) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    // Twenty frames a second; the first comes 0.73 s into a second, and the sender's clock gains 50 ppm.
    double worst_s = 0.0;
    double before_s = 0.0;
    double largest_step_s = 0.0;
    for (int i = 0; i < 20 * 600; ++i) {
        const double t = i * 0.05;
        const double true_s = 40'000.73 + t * 1.000'05;
        clock.set_time_of_day(std::floor(true_s), 1.0, ns(t));
        const double now_s = shown(clock, t + 0.04);
        EXPECT_GE(now_s, before_s);
        if (i > 0) largest_step_s = std::max(largest_step_s, now_s - before_s);
        before_s = now_s;
        if (t > 5.0) worst_s = std::max(worst_s, std::abs(now_s - (true_s + 0.04)));
    }
    std::printf("whole seconds at 20 Hz: within %.3f s, at most %.3f s a twentieth\n", worst_s,
                largest_step_s);
    EXPECT_LT(worst_s, 0.06);
    EXPECT_LT(largest_step_s, 0.11);  // slewed, at most at double speed
    EXPECT_EQ(clock.steps(), 1U);
}

TEST(BusClockTest, ASenderThatStandsStillHoldsTheClock) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    double before_s = 0.0;
    for (int second = 0; second < 600; ++second) {
        clock.set_time_of_day(30'000.0, 1.0, ns(second));
        const double now_s = shown(clock, second);
        EXPECT_GE(now_s, before_s);
        before_s = now_s;
    }
    std::printf("time frozen by its sender: clock stands %.2f s further\n", before_s - 30'000.0);
    EXPECT_LE(before_s, 30'002.01);
    EXPECT_EQ(clock.steps(), 1U);
}

TEST(BusClockTest, LeapSecondIsShownOnce) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    const double day_s = 86'400.0;
    double before_s = 0.0;
    for (int second = 0; second < 10; ++second) {
        // 23:59:57, 58, 59, 60, 00:00:00, ...
        const double sent_s = second < 4 ? day_s - 3.0 + second : second - 4.0;
        clock.set_time_of_day(sent_s, 1.0, ns(second));
        for (double t = second; t < second + 0.99; t += 0.1) {
            const BusTime time = clock.at(ns(t)).value();
            EXPECT_EQ(time.day, kDate + (second < 4 ? 0 : 1)) << t;
            EXPECT_NEAR(time.second_of_day, sent_s + (t - second), 1e-6) << t;
            const double passed_s =
                static_cast<double>(time.day - kDate) * (day_s + 1.0) + time.second_of_day;
            EXPECT_GE(passed_s, before_s - 1e-9);
            before_s = passed_s;
        }
    }
    EXPECT_EQ(clock.steps(), 1U);
}

TEST(BusClockTest, LeapSecondOutOfTheBlueAndAsTheFirstFrame) {
    BusClock clock;
    clock.set_date(kDate, ns(0));
    clock.set_time_of_day(86'400.0, 1.0, ns(0));
    EXPECT_NEAR(clock.at(ns(0.5))->second_of_day, 86'400.5, 1e-6);
    EXPECT_EQ(clock.at(ns(0.5))->day, kDate);
    EXPECT_NEAR(clock.at(ns(1.5))->second_of_day, 0.5, 1e-6);
    EXPECT_EQ(clock.at(ns(1.5))->day, kDate + 1);
    clock.set_date(kDate + 1, ns(2));
    clock.set_time_of_day(43'200.0, 1.0, ns(2));
    clock.set_time_of_day(86'400.0, 1.0, ns(3));
    EXPECT_NEAR(clock.at(ns(3.25))->second_of_day, 86'400.25, 1e-6);
    EXPECT_EQ(clock.at(ns(3.25))->day, kDate + 1);
}

TEST(BusClockTest, MillisecondsJulianDatesAndRates) {
    BusClock clock;
    clock.set_julian_date(2'440'587.5 + static_cast<double>(kDate) + 0.5, ns(0));
    EXPECT_NEAR(shown(clock, 0), 43'200.0, 1e-4);
    clock.set_time_of_day(43'200.25, 0.001, ns(0));
    EXPECT_NEAR(shown(clock, 1), 43'201.25, 1e-6);
    EXPECT_EQ(clock.steps(), 1U);
    clock.set_rate(0.0, ns(2));
    EXPECT_NEAR(shown(clock, 100), 43'202.25, 1e-6);
    clock.set_rate(60.0, ns(100));
    EXPECT_NEAR(shown(clock, 101), 43'262.25, 1e-6);
    EXPECT_EQ(clock.rate(), 60.0);
}

}  // namespace
}  // namespace skyig::protocol::canaerospace
