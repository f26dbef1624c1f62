#include "render/eye/adaptation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skyig::render::eye {
namespace {

TEST(Adaptation, FirstFrameIsAdaptedAtOnce) {
    Adaptation eye;
    EXPECT_DOUBLE_EQ(eye.update(250.0, 1234.5, false, {}), 250.0);
}

TEST(Adaptation, ApproachesByTimeConstantWhateverTheFrameRate) {
    DisplaySettings display;
    display.adapt_up_s = 0.5;
    display.adapt_down_s = 5.0;
    for (const double rate : {10.0, 30.0, 240.0}) {
        Adaptation eye;
        eye.update(1.0, 0.0, false, display);
        const int frames = static_cast<int>(rate);
        for (int i = 1; i <= frames; ++i)
            eye.update(100.0, i / rate, false, display);
        // After 1 s, two time constants, 1 - e^-2 of the two decades are gone.
        EXPECT_NEAR(std::log10(eye.luminance_cd_m2()), 2.0 * (1.0 - std::exp(-2.0)), 1e-9) << rate;
        const double bright = eye.luminance_cd_m2();
        for (int i = 1; i <= frames; ++i)
            eye.update(1.0, 1.0 + i / rate, false, display);
        EXPECT_NEAR(std::log10(eye.luminance_cd_m2()), std::log10(bright) * std::exp(-0.2), 1e-9) << rate;
    }
}

TEST(Adaptation, JumpsOfTheClockSnap) {
    Adaptation eye;
    eye.update(1.0, 100.0, false, {});
    EXPECT_DOUBLE_EQ(eye.update(50.0, 99.0, false, {}), 50.0);
    EXPECT_DOUBLE_EQ(eye.update(3.0, 99.0 + Adaptation::kJump_s + 0.1, false, {}), 3.0);
    EXPECT_DOUBLE_EQ(eye.update(7.0, std::nan(""), false, {}), 7.0);
}

TEST(Adaptation, FrozenClockHoldsTheState) {
    Adaptation eye;
    eye.update(1.0, 100.0, false, {});
    for (int i = 0; i < 10; ++i)
        EXPECT_DOUBLE_EQ(eye.update(80.0, 100.0, false, {}), 1.0);
}

TEST(Adaptation, MoveOfTheEyeSnapsWhileTheClockRuns) {
    Adaptation eye;
    eye.update(5000.0, 100.0, false, {});
    EXPECT_DOUBLE_EQ(eye.update(1e-4, 100.03, true, {}), 1e-4);
}

TEST(Adaptation, WhatIsNoLuminanceIsIgnored) {
    Adaptation eye;
    eye.update(5.0, 100.0, false, {});
    EXPECT_DOUBLE_EQ(eye.update(std::nan(""), 100.1, false, {}), 5.0);
    EXPECT_DOUBLE_EQ(eye.update(0.0, 100.2, true, {}), 5.0);
    EXPECT_TRUE(std::isfinite(eye.update(6.0, 100.3, false, {})));
    std::array<double, kProbeCount> luminance{};
    luminance.fill(2.0);
    luminance[3] = std::nan("");
    EXPECT_GT(adaptation_target_cd_m2(luminance), 1.0);
}

TEST(Adaptation, TargetIsTheLogAverageWithoutFallingToZero) {
    std::array<double, kProbeCount> luminance{};
    EXPECT_NEAR(adaptation_target_cd_m2(luminance), 1e-5, 1e-12);
    for (std::size_t i = 0; i < kProbeCount; ++i)
        luminance[i] = i % 2 == 0 ? 1.0 : 25.0;
    EXPECT_NEAR(adaptation_target_cd_m2(luminance), 5.0, 1e-3);
    // Three quarters black space, a quarter sunlit Earth.
    for (std::size_t i = 0; i < kProbeCount; ++i)
        luminance[i] = i % 4 == 0 ? 4000.0 : 0.0;
    EXPECT_NEAR(adaptation_target_cd_m2(luminance), 1000.0 / 3.0, 1e-9);
}

TEST(Adaptation, ProbesStandEvenlyRoundTheHorizon) {
    double east = 0.0;
    double north = 0.0;
    for (const ProbeDirection& probe : probe_directions()) {
        east += std::sin(probe.azimuth_rad);
        north += std::cos(probe.azimuth_rad);
    }
    EXPECT_NEAR(east, 0.0, 1e-9);
    EXPECT_NEAR(north, 0.0, 1e-9);
}

}  // namespace
}  // namespace skyig::render::eye
