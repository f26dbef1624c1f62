#include "render/fog/rvr.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace skyig::render::fog {
namespace {

constexpr std::array kExtinctions{0.0, 1e-9, 1e-6, 1e-4, 2.996e-3, 0.02, 0.1, 1.0, 1e4};
constexpr std::array kIntensities{1e-6, 10.0, 1000.0, 10e3, 200e3, 1e9};
constexpr std::array kBackgrounds{0.0, 0.5, 15.0, 1000.0, 30e3};

// In the logarithm of the distance, where E - E_t falls all the way.
double bisected_m(double intensity_cd, double extinction_per_m, double threshold_lux) {
    double low = -40.0;
    double high = 40.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        const double range_m = std::exp(middle);
        const double log_lux = std::log(intensity_cd) - extinction_per_m * range_m - 2.0 * middle;
        (log_lux > std::log(threshold_lux) ? low : high) = middle;
    }
    return std::exp(0.5 * (low + high));
}

TEST(Rvr, AllardIsWhereBisectionFindsIt) {
    double largest = 0.0;
    for (const double extinction : kExtinctions) {
        for (const double intensity : kIntensities) {
            for (const double background : kBackgrounds) {
                const double threshold = light_threshold_lux(background);
                const double wanted = bisected_m(intensity, extinction, threshold);
                const double got = allard_range_m(intensity, extinction, threshold);
                ASSERT_TRUE(std::isfinite(got));
                largest = std::max(largest, std::abs(got / wanted - 1.0));
            }
        }
    }
    std::printf("largest relative difference %.2e\n", largest);
    EXPECT_LT(largest, 1e-10);
}

TEST(Rvr, TheThresholdPassesThroughTheStepsOfTheManual) {
    // Night, twilight, day, bright day, at the middle or the end of their backgrounds: within a factor of 2.
    for (const auto& [background, lux] :
         {std::pair{15.0, 8e-7}, std::pair{200.0, 1e-5}, std::pair{3000.0, 1e-4}, std::pair{40e3, 1e-3}}) {
        const double factor = light_threshold_lux(background) / lux;
        std::printf("%6.0f cd/m2: %.2e lx, %.2f of the step\n", background, lux * factor, factor);
        EXPECT_GT(factor, 1.0 / 1.9);
        EXPECT_LT(factor, 1.9);
    }
    EXPECT_EQ(light_threshold_lux(0.0), light_threshold_lux(1.0));
}

TEST(Rvr, LightsCarryFartherThanMarksByNightAndNotInBrightFogOfWeakLights) {
    const double sigma = 2.996 / 300.0;
    const RunwayVisualRange night = runway_visual_range(sigma, 10e3, 15.0);
    EXPECT_NEAR(night.koschmieder_m, 300.0, 0.1);
    EXPECT_GT(night.allard_m, 2.5 * night.koschmieder_m);
    EXPECT_EQ(night.range_m, night.allard_m);
    const RunwayVisualRange day = runway_visual_range(sigma, 30.0, 20e3);
    EXPECT_EQ(day.range_m, day.koschmieder_m);
}

TEST(Rvr, WhatTheInstructorSetsIsWhatIsSeen) {
    for (const double range_m : {50.0, 75.0, 200.0, 350.0, 550.0, 1500.0}) {
        for (const double intensity : {0.0, 30.0, 10e3, 200e3}) {
            for (const double background : kBackgrounds) {
                const double sigma = extinction_for_range(range_m, intensity, background);
                EXPECT_NEAR(runway_visual_range(sigma, intensity, background).range_m, range_m,
                            1e-9 * range_m);
            }
        }
    }
}

TEST(Rvr, HardInputHasAnAnswer) {
    EXPECT_EQ(allard_range_m(0.0, 0.01, 1e-4), 0.0);
    EXPECT_EQ(allard_range_m(-5.0, 0.01, 1e-4), 0.0);
    EXPECT_NEAR(allard_range_m(1e4, 0.0, 1e-4), 1e4, 1e-6);
    EXPECT_NEAR(allard_range_m(1e4, -1.0, 1e-4), 1e4, 1e-6);
    EXPECT_EQ(koschmieder_range_m(0.0), std::numeric_limits<double>::infinity());
    EXPECT_GT(allard_range_m(1e4, 1.0, 1e-6), 10.0);
}

}  // namespace
}  // namespace skyig::render::fog
