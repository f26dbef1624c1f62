#include "render/fog/obscurants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "render/weather_area.h"

namespace skyig::render::fog {
namespace {

TEST(Profile, HasAShellForEveryBendAndAddsWhatOverlaps) {
    const std::array layers{
        Obscurant{.base_m = 0.0, .top_m = 100.0, .top_band_m = 50.0, .extinction_per_m = 0.01},
        Obscurant{.kind = Obscurant::Kind::kSmoke, .base_m = 50.0, .top_m = 120.0, .extinction_per_m = 0.03}};
    Profile profile;
    profile.lay(layers, 0.0);
    ASSERT_EQ(profile.shells().size(), 4U);
    const auto& s = profile.shells();
    EXPECT_EQ(s[0].high_m, 50.0);
    EXPECT_NEAR(s[0].high_per_m, 0.01, 1e-15);
    EXPECT_NEAR(s[1].low_per_m, 0.04, 1e-15);
    EXPECT_NEAR(s[1].optics.g, (0.85 * 0.01 + 0.6 * 0.03) / 0.04, 1e-12);
    EXPECT_EQ(s[2].high_m, 120.0);
    EXPECT_NEAR(s[2].high_per_m, 0.01 * 0.6 + 0.03, 1e-15);
    EXPECT_NEAR(s[3].low_per_m, 0.01 * 0.6, 1e-15);
    EXPECT_EQ(s[3].high_per_m, 0.0);
}

TEST(Profile, WhatIsNothingLaysNothing) {
    Profile profile;
    profile.lay({}, 0.0);
    EXPECT_TRUE(profile.empty());
    const std::array layers{Obscurant{.extinction_per_m = 0.0},
                            Obscurant{.base_m = 10.0, .top_m = 10.0, .extinction_per_m = 1.0},
                            Obscurant{.base_m = -90.0, .top_m = -10.0, .extinction_per_m = 1.0},
                            Obscurant{.extinction_per_m = 1.0, .coverage = 0.0}};
    profile.lay(layers, 0.0);
    EXPECT_TRUE(profile.empty());
}

// Along a runway through patches of fog, drawn by chance cell by cell: the mean over many of them.
TEST(MeanExtinction, IsThatOfTheMeanTransmittanceOfPatches) {
    std::mt19937 random(7);
    std::bernoulli_distribution covered(0.4);
    const Obscurant fog{.base_m = 0.0, .top_m = 60.0, .extinction_per_m = 0.02, .coverage = 0.4};
    constexpr int kCells = 5;
    constexpr int kTrials = 200000;
    double sum = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
        int hit = 0;
        for (int cell = 0; cell < kCells; ++cell)
            hit += covered(random) ? 1 : 0;
        sum += std::exp(-0.02 * 60.0 * hit);
    }
    const double mean = std::exp(-mean_extinction_per_m(fog) * 60.0 * kCells);
    std::printf("mean transmittance %.5f, drawn by chance %.5f\n", mean, sum / kTrials);
    EXPECT_NEAR(mean, sum / kTrials, 0.003 * mean);
    Obscurant whole = fog;
    whole.coverage = 1.0;
    EXPECT_EQ(mean_extinction_per_m(whole), 0.02);
    whole.coverage = 1.0 - 1e-12;
    EXPECT_NEAR(mean_extinction_per_m(whole), 0.02, 1e-9);
    // Thick patches: the gaps alone let light through.
    Obscurant thick = fog;
    thick.extinction_per_m = 1e4;
    EXPECT_NEAR(std::exp(-mean_extinction_per_m(thick) * 60.0), 0.6, 1e-9);
}

TEST(AreaWeight, IsOneInsideAndFallsOverThePerimeter) {
    // 4 km by 2 km with its long side to the north-east, corners of 500 m, 1 km of perimeter.
    WeatherArea area{.centre_m = {1000.0, 2000.0},
                     .axis_rad = 0.25 * std::numbers::pi,
                     .half_size_m = {2000.0, 1000.0},
                     .corner_radius_m = 500.0,
                     .perimeter_m = 1000.0};
    const glm::dvec2 along{std::sqrt(0.5), std::sqrt(0.5)};
    const glm::dvec2 across{std::sqrt(0.5), -std::sqrt(0.5)};
    EXPECT_EQ(area_weight(area, area.centre_m), 1.0);
    EXPECT_EQ(area_weight(area, area.centre_m + 2499.0 * along), 1.0);
    EXPECT_NEAR(area_weight(area, area.centre_m + 3000.0 * along), 0.5, 1e-12);
    EXPECT_NEAR(area_weight(area, area.centre_m + 2000.0 * across), 0.5, 1e-12);
    EXPECT_EQ(area_weight(area, area.centre_m + 3501.0 * along), 0.0);
    // Beside a corner the distance counts.
    EXPECT_NEAR(area_weight(area, area.centre_m + 2600.0 * along + 1800.0 * across), 0.5, 1e-12);
    area.perimeter_m = 0.0;
    EXPECT_EQ(area_weight(area, area.centre_m + 2501.0 * along), 0.0);
}

}  // namespace
}  // namespace skyig::render::fog
