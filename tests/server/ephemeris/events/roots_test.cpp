// Zeros and minima inside brackets, of functions that are not kind.
#include "server/ephemeris/events/roots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace skyig::server::ephemeris::events {
namespace {

template <typename Function>
double zero_of(const Function& f, double a, double b, int& calls) {
    const auto counted = [&](double x) {
        ++calls;
        return f(x);
    };
    return zero_between(counted, a, f(a), b, f(b), 1e-9);
}

TEST(Roots, ZeroIsFoundWhereTheFunctionBendsHard) {
    int calls = 0;
    EXPECT_NEAR(zero_of([](double x) { return std::pow(x, 15) - 1e-6; }, 0.0, 2.0, calls),
                std::pow(1e-6, 1.0 / 15.0), 2e-9);
    EXPECT_NEAR(zero_of([](double x) { return x < 0.7 ? -1e-12 : 1.0; }, 0.0, 1.0, calls), 0.7, 2e-9);
    EXPECT_NEAR(zero_of([](double x) { return 3.0 - x; }, -5.0, 9.0, calls), 3.0, 2e-9);
    std::printf("three zeros to 1e-9: %d calls\n", calls);
    EXPECT_LE(calls, 240);
}

TEST(Roots, ZeroAtAnEndOfTheBracketIsThatEnd) {
    int calls = 0;
    EXPECT_EQ(zero_of([](double x) { return x; }, 0.0, 5.0, calls), 0.0);
    EXPECT_EQ(zero_of([](double x) { return x - 5.0; }, 0.0, 5.0, calls), 5.0);
}

TEST(Roots, SmoothZeroTakesFewCalls) {
    int calls = 0;
    EXPECT_NEAR(zero_of([](double x) { return std::sin(x); }, 3.0, 3.5, calls), std::acos(-1.0), 2e-9);
    EXPECT_LE(calls, 10);
}

TEST(Roots, MinimumIsFoundAlsoWhereItIsACorner) {
    EXPECT_NEAR(minimum_between([](double x) { return (x - 0.3) * (x - 0.3); }, -4.0, 2.0, 1e-6), 0.3, 1e-5);
    EXPECT_NEAR(minimum_between([](double x) { return std::abs(x - 0.3); }, -4.0, 2.0, 1e-9), 0.3, 2e-9);
}

}  // namespace
}  // namespace skyig::server::ephemeris::events
