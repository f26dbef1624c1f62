#include "render/night/star_scintillation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace skyig::render::night {
namespace {

struct Moments {
    double mean = 0.0;
    double rms_of_log = 0.0;
};

// Over stars and frames, at some phase between the frames.
Moments moments(float rms, double phase) {
    constexpr int kStars = 100, kFrames = 500;
    double sum = 0.0, logs = 0.0, squares = 0.0;
    for (std::uint32_t star = 0; star < kStars; ++star) {
        for (int frame = 0; frame < kFrames; ++frame) {
            const auto light = static_cast<double>(scintillation(star, (frame + phase) / 30.0, rms));
            sum += light;
            logs += std::log(light);
            squares += std::log(light) * std::log(light);
        }
    }
    constexpr double kCount = kStars * kFrames;
    const double log_mean = logs / kCount;
    return {sum / kCount, std::sqrt(squares / kCount - log_mean * log_mean)};
}

TEST(Scintillation, KeepsTheMeanLightAndHasTheDeviationAskedForAtAnyTime) {
    for (const float rms : {0.05F, 0.2F, 0.5F}) {
        for (const double phase : {0.0, 0.3, 0.5}) {
            const Moments m = moments(rms, phase);
            std::printf("rms %.2f, phase %.1f: mean %.4f, rms %.4f\n", static_cast<double>(rms), phase,
                        m.mean, m.rms_of_log);
            EXPECT_NEAR(m.mean, 1.0, 0.004 + 0.02 * static_cast<double>(rms));
            EXPECT_NEAR(m.rms_of_log / static_cast<double>(rms), 1.0, 0.02);
        }
    }
}

TEST(Scintillation, IsTheSameForTheSameStarAndTimeAndRunsSmoothly) {
    EXPECT_EQ(scintillation(7, 12.34, 0.3F), scintillation(7, 12.34, 0.3F));
    EXPECT_NE(scintillation(7, 12.34, 0.3F), scintillation(8, 12.34, 0.3F));
    EXPECT_NE(scintillation(7, 12.34, 0.3F), scintillation(7, 13.34, 0.3F));
    float largest = 0.0F;
    for (int i = 0; i < 20000; ++i) {
        const double t = 1000.0 + i * 1e-4;
        largest = std::max(largest, std::abs(scintillation(3, t + 1e-4, 0.3F) - scintillation(3, t, 0.3F)));
    }
    EXPECT_LT(largest, 0.03F);
    EXPECT_EQ(scintillation(7, 12.34, 0.0F), 1.0F);
    EXPECT_EQ(scintillation(7, std::numeric_limits<double>::quiet_NaN(), 0.3F), 1.0F);
    EXPECT_GT(scintillation(7, -1e300, 0.3F), 0.0F);
}

TEST(Scintillation, GrowsTowardsTheHorizonAndIsGoneHighUp) {
    // Of a frame's mean 0.82 is left.
    EXPECT_NEAR(scintillation_rms(1.0, 0.0), 0.08 * 0.82, 1e-3);
    EXPECT_NEAR(scintillation_rms(2.0, 0.0), 0.08 * 3.364 * 0.82, 2e-3);
    EXPECT_NEAR(scintillation_rms(38.0, 0.0), 0.5 * 0.82, 5e-3);
    EXPECT_NEAR(scintillation_rms(1.0, 8000.0) / scintillation_rms(1.0, 0.0), std::exp(-1.0), 1e-9);
}

TEST(Scintillation, HardlyEverAddsMoreThanItsStrongest) {
    for (const double height_m : {0.0, 3e3, 20e3}) {
        const auto rms = static_cast<float>(scintillation_rms(air_mass(0.0), height_m));
        const auto strongest = static_cast<float>(strongest_flicker(height_m));
        float largest = 0.0F;
        int beyond = 0;
        constexpr int kTimes = 50000;
        for (int i = 0; i < kTimes; ++i) {
            const float added = scintillation(5, i / 30.0, rms) - 1.0F;
            largest = std::max(largest, added);
            beyond += added > strongest ? 1 : 0;
        }
        std::printf("%5.0f m: strongest %.3f, seen %.3f, beyond it %d of %d\n", height_m,
                    static_cast<double>(strongest), static_cast<double>(largest), beyond, kTimes);
        EXPECT_GT(largest, 0.9F * strongest);
        EXPECT_LT(beyond, kTimes / 500);
    }
    EXPECT_LT(strongest_flicker(300e3), 1e-15);
}

TEST(AirMass, IsKastenAndYoungs) {
    constexpr double kDegree = 0.017453292519943295;
    EXPECT_NEAR(air_mass(90.0 * kDegree), 1.0, 1e-3);
    EXPECT_NEAR(air_mass(30.0 * kDegree), 1.994, 1e-3);
    EXPECT_NEAR(air_mass(5.0 * kDegree), 10.31, 0.02);
    EXPECT_NEAR(air_mass(0.0), 37.9, 0.1);
    EXPECT_EQ(air_mass(-0.02), air_mass(0.0));
}

}  // namespace
}  // namespace skyig::render::night
