#include "server/ephemeris/theory/sine_series.h"
#include "tests/server/ephemeris/largest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace {

using namespace skyig::server::ephemeris::theory;

constexpr double kPi = std::numbers::pi;

/// A pair whose second term is nothing.
TermPair<1> one_sine(double amplitude, double phase_rad) {
    return {.amplitude = {amplitude, 0.0}, .phase = {{{phase_rad, 0.0}}}};
}

double sine_of(double phase_rad) {
    const std::array pair{one_sine(1.0, phase_rad)};
    return sum_of_sines<1>(pair, 0.0).value;
}

TEST(SineSeries, SineAgreesWithTheLibraryAllAroundTheCircleAndAtHalfTurns) {
    double greatest = 0.0;
    for (int i = -4000; i <= 4000; ++i) {
        const double phase_rad = i * (kPi / 1000.0);
        skyig::tests::raise(greatest, sine_of(phase_rad) - std::sin(phase_rad));
    }
    for (const double turns : {0.25, 0.5, 0.75, 1.0, 12345.25, 12345.5}) {
        for (const double side : {-1e-9, 0.0, 1e-9}) {
            const double phase_rad = (turns + side) * 2.0 * kPi;
            skyig::tests::raise(greatest, sine_of(phase_rad) - std::sin(phase_rad));
            skyig::tests::raise(greatest, sine_of(-phase_rad) + std::sin(phase_rad));
        }
    }
    std::printf("sine: error at most %.2g\n", greatest);
    EXPECT_LE(greatest, 5e-16);
}

TEST(SineSeries, SineKeepsItsDigitsAtPhasesOfAMillionTurns) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> phase(-2e6 * kPi, 2e6 * kPi);
    double greatest = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double phase_rad = phase(random);
        skyig::tests::raise(greatest, sine_of(phase_rad) - std::sin(phase_rad));
    }
    std::printf("sine, phases up to a million turns: error at most %.2g\n", greatest);
    EXPECT_LE(greatest, 5e-16);
}

TEST(SineSeries, ValueAndRateAreThoseOfTheFormula) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const std::array scales{kPi, 8e4, 1e-3, 1e-6, 1e-9};
    std::vector<TermPair<5>> pairs(200);
    for (TermPair<5>& pair : pairs) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            pair.amplitude[lane] = unit(random);
            for (std::size_t i = 0; i < 5; ++i)
                pair.phase[i][lane] = scales[i] * unit(random);
        }
    }
    double greatest = 0.0;
    double greatest_rate = 0.0;
    for (double t = -1.0; t <= 1.0; t += 0.01) {
        double value = 0.0;
        double rate = 0.0;
        for (const TermPair<5>& pair : pairs) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                double phase_rad = 0.0;
                double phase_rate_rad = 0.0;
                for (std::size_t i = 5; i-- > 0;) {
                    phase_rad += pair.phase[i][lane] * std::pow(t, static_cast<double>(i));
                    if (i > 0)
                        phase_rate_rad += static_cast<double>(i) * pair.phase[i][lane] *
                                          std::pow(t, static_cast<double>(i) - 1.0);
                }
                value += pair.amplitude[lane] * std::sin(phase_rad);
                rate += pair.amplitude[lane] * std::cos(phase_rad) * phase_rate_rad;
            }
        }
        const Varying sum = sum_of_sines<5>(pairs, t);
        skyig::tests::raise(greatest, sum.value - value);
        skyig::tests::raise(greatest_rate, sum.rate - rate);
    }
    std::printf("400 terms of amplitude up to 1: value within %.2g, rate within %.2g of 8e4\n", greatest,
                greatest_rate);
    EXPECT_LE(greatest, 3e-10);
    EXPECT_LE(greatest_rate, 3e-5);
}

TEST(SineSeries, PowersOfTimeMultiplyTheirSums) {
    // (2 sin 0.3) + t (5 sin 0.7) + nothing t^2 + t^3 (4 sin 1.1)
    const std::array table{one_sine(2.0, 0.3), one_sine(5.0, 0.7), one_sine(4.0, 1.1)};
    const std::array<TermRange, 4> powers{{{0, 1}, {1, 1}, {2, 0}, {2, 1}}};
    for (const double t : {-1.5, 0.0, 0.25, 2.0}) {
        const Varying sum = poisson_series<1>(table, powers, t);
        const double linear = 5.0 * std::sin(0.7);
        const double cubic = 4.0 * std::sin(1.1);
        EXPECT_NEAR(sum.value, 2.0 * std::sin(0.3) + t * linear + t * t * t * cubic, 1e-13);
        EXPECT_NEAR(sum.rate, linear + 3.0 * t * t * cubic, 1e-13);
    }
}

TEST(SineSeries, PolynomialGivesValueAndDerivative) {
    constexpr std::array kCoefficients{1.0, -2.0, 3.0, 0.5};
    const Varying at = polynomial(kCoefficients, 2.0);
    EXPECT_DOUBLE_EQ(at.value, 1.0 - 4.0 + 12.0 + 4.0);
    EXPECT_DOUBLE_EQ(at.rate, -2.0 + 12.0 + 6.0);
}

TEST(SineSeries, NotANumberInGivesNotANumberOutAndHugePhasesStayBounded) {
    const std::array pair{TermPair<2>{.amplitude = {1.0, 2.0}, .phase = {{{0.1, 0.2}, {1.0, 2.0}}}}};
    EXPECT_TRUE(std::isnan(sum_of_sines<2>(pair, std::numeric_limits<double>::quiet_NaN()).value));
    for (const double t : {1e9, -1e12}) {
        const Varying sum = sum_of_sines<2>(pair, t);
        EXPECT_LE(std::abs(sum.value), 3.1) << t;
        EXPECT_LE(std::abs(sum.rate), 5.1) << t;
    }
}

}  // namespace
