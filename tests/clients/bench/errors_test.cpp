#include "clients/bench/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace skyig::clients::bench {
namespace {

TEST(Errors, FiguresOfAHundredCasesAreKnownInClosedForm) {
    ErrorSamples samples;
    for (int i = 100; i >= 1; --i)
        samples.add(i % 2 == 0 ? i : -i);
    const ErrorFigures figures = samples.figures();
    EXPECT_EQ(figures.count, 100U);
    EXPECT_EQ(figures.max, 100.0);
    EXPECT_EQ(figures.p95, 95.0);
    // Sum of squares n (n + 1) (2 n + 1) / 6.
    EXPECT_NEAR(figures.rms, std::sqrt(101.0 * 201.0 / 6.0), 1e-12);
}

TEST(Errors, FewCasesHaveTheLargestAsNinetyFifthPercentile) {
    for (int count = 1; count < 20; ++count) {
        ErrorSamples samples;
        for (int i = 1; i <= count; ++i)
            samples.add(i);
        EXPECT_EQ(samples.figures().p95, count);
    }
}

TEST(Errors, NoCasesAreZeroAndCountNone) {
    EXPECT_EQ(ErrorSamples().figures(), ErrorFigures());
}

TEST(Errors, WhatIsNotFiniteIsRefused) {
    ErrorSamples samples;
    EXPECT_THROW(samples.add(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
    EXPECT_THROW(samples.add(-std::numeric_limits<double>::infinity()), std::domain_error);
    EXPECT_EQ(samples.figures().count, 0U);
}

}  // namespace
}  // namespace skyig::clients::bench
