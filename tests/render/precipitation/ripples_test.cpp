// Rings in water against what the wave equation says of them.
#include "render/precipitation/ripples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace skyig::render::precipitation {
namespace {

double largest(const Ripples& water) {
    float most = 0.0F;
    for (int row = 0; row < Ripples::kCells; ++row) {
        for (int column = 0; column < Ripples::kCells; ++column)
            most = std::max(most, std::abs(water.height(column, row)));
    }
    return static_cast<double>(most);
}

// A standing wave of the tile: the difference equation of each has a closed form, a damped swing by an angle
// a step of cos = sqrt(d) (1 - 2 r^2 sin^2(k dx / 2)).
TEST(Ripples, SwingAsTheWaveEquationHasIt) {
    Ripples water;
    constexpr int kWaves = 4;
    const double k = 2.0 * std::numbers::pi * kWaves / Ripples::kCells;
    for (int row = 0; row < Ripples::kCells; ++row) {
        for (int column = 0; column < Ripples::kCells; ++column) {
            // push() spreads over a cross of five.
            const double gain = 1.0 + (std::cos(k) + 1.0);
            water.push(column, row, static_cast<float>(std::cos(k * column) / gain));
        }
    }
    EXPECT_NEAR(water.height(0, 0), 1.0, 1e-4);
    EXPECT_NEAR(water.height(Ripples::kCells / kWaves / 2, 0), -1.0, 1e-4);
    const double root = std::sqrt(static_cast<double>(Ripples::kDamping));
    const double share = static_cast<double>(Ripples::kRatio) * std::sin(0.5 * k);
    const double angle = std::acos(root * (1.0 - 2.0 * share * share));
    const double sine_part = (std::cos(angle) - root) / std::sin(angle);
    double worst = 0.0;
    for (int i = 1; i <= 100; ++i) {
        water.step();
        const double wanted = std::pow(root, i) * (std::cos(i * angle) + sine_part * std::sin(i * angle));
        worst = std::max(worst, std::abs(static_cast<double>(water.height(0, 7)) - wanted));
    }
    std::printf("worst of 100 steps: %.1e of the height\n", worst);
    EXPECT_LT(worst, 1e-4);
}

TEST(Ripples, SpreadAlikeToAllSidesOverTheTilesEdgesAndDieAway) {
    Ripples water;
    water.push(0, 0, 1.0F);
    for (int i = 0; i < 30; ++i)
        water.step();
    for (const int d : {5, 10, 14}) {
        EXPECT_NEAR(water.height(d, 0), water.height(-d, 0), 1e-6);
        EXPECT_NEAR(water.height(0, d), water.height(0, -d), 1e-6);
        EXPECT_NEAR(water.height(d, 0), water.height(0, d), 1e-6);
    }
    // No faster than r cells a step; the scheme's own reach is one cell a step.
    EXPECT_EQ(water.height(40, 0), 0.0F);
    const double then = largest(water);
    EXPECT_GT(then, 0.0);
    for (int i = 0; i < 2000; ++i)
        water.step();
    EXPECT_LT(largest(water), 1e-3 * then);
}

TEST(Ripples, AreTheSameForTwoAndStandWithTheClock) {
    Ripples one;
    Ripples two;
    for (int i = 0; i < 120; ++i) {
        const double time_s = 100.0 + i / 30.0;
        one.advance(time_s, 10.0);
        two.advance(time_s, 10.0);
    }
    EXPECT_TRUE(std::equal(one.slopes().begin(), one.slopes().end(), two.slopes().begin()));
    EXPECT_FALSE(one.advance(100.0 + 119 / 30.0, 10.0));
    EXPECT_FALSE(one.advance(5000.0, 10.0)) << "a jump of the clock";
    EXPECT_TRUE(one.advance(5000.1, 10.0));
    const float steepest = *std::max_element(one.slopes().begin(), one.slopes().end());
    std::printf("steepest slope in 10 mm/h: %.3f\n", static_cast<double>(steepest));
    EXPECT_GT(steepest, 0.01F);
    EXPECT_LT(steepest, 0.6F);
    Ripples dry;
    dry.advance(0.0, 0.0);
    dry.advance(0.2, 0.0);
    EXPECT_EQ(largest(dry), 0.0);
}

}  // namespace
}  // namespace skyig::render::precipitation
