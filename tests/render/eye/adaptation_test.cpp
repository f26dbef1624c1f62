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

TEST(Adaptation, ResumedEyesWentOnAdaptingHoweverLongAgoThatWas) {
    Adaptation eye;
    eye.update(100.0, 10.0, false, {});
    Adaptation seen = eye;
    for (int i = 1; i <= 300; ++i)
        seen.update(1.0, 10.0 + 0.1 * i, false, {});
    Adaptation resumed = eye;
    resumed.resume();
    EXPECT_NEAR(resumed.update(1.0, 40.0, true, {}), seen.luminance_cd_m2(), 1e-9);
    // Once: the next leap snaps again.
    EXPECT_DOUBLE_EQ(resumed.update(7.0, 50.0, true, {}), 7.0);
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
    LuminanceMean mean;
    for (int i = 0; i < 83; ++i)
        mean.add(2.0);
    mean.add(std::nan(""));
    EXPECT_GT(mean.log_average_cd_m2(), 1.0);
    EXPECT_NEAR(mean.mean_cd_m2(), 2.0 * 83.0 / 84.0, 1e-12);
}

TEST(Adaptation, CloseToTheThresholdsOfFerwerdaTheMoreSensitiveReceptorDecides) {
    for (double log_l = -6.0; log_l <= 5.0; log_l += 0.1) {
        // A settled eye is adapted to what it sees.
        EXPECT_NEAR(equivalent_log_adaptation(log_l, log_l), log_l, 1e-12) << log_l;
    }
    // By day the rods' state is of no matter, in the dark that of the cones is not.
    EXPECT_DOUBLE_EQ(equivalent_log_adaptation(2.0, 3.5), 2.0);
    EXPECT_DOUBLE_EQ(equivalent_log_adaptation(-2.0, -3.0), -3.0);
}

TEST(Adaptation, InTheDarkTheRodsTakeOverFromTheConesAfterSomeMinutes) {
    DisplaySettings display;
    display.adapt_pace = AdaptationPace::kPhysiological;
    Adaptation eye;
    double last = eye.update(3000.0, 0.0, false, display);
    double five_minutes = 0.0;
    double first_minute = 0.0;
    for (int second = 1; second <= 3600; ++second) {
        const double now = eye.update(1e-4, second, false, display);
        EXPECT_LE(now, last) << second;
        last = now;
        if (second == 60) first_minute = now;
        if (second == 300) five_minutes = now;
    }
    std::printf("dark for 1 min: %.3g, 5 min: %.3g, 1 h: %.3g cd/m2\n", first_minute, five_minutes, last);
    // exp(-60 / 110) of 7.48 decades are left for the cones, exp(-300 / 400) for the rods.
    EXPECT_NEAR(std::log10(first_minute), -4.0 + 7.477 * std::exp(-60.0 / 110.0), 1e-3);
    EXPECT_NEAR(std::log10(five_minutes), -4.0 + 7.477 * std::exp(-300.0 / 400.0), 1e-3);
    EXPECT_NEAR(std::log10(last), -4.0, 1e-2);
    // Light is met at once.
    EXPECT_NEAR(std::log10(eye.update(3000.0, 3601.0, false, display)), std::log10(3000.0), 0.01);
}

TEST(Adaptation, TargetIsTheLogAverageWithoutFallingToZero) {
    EXPECT_NEAR(LuminanceMean().log_average_cd_m2(), 1e-5, 1e-12);
    LuminanceMean two;
    for (int i = 0; i < 84; ++i)
        two.add(i % 2 == 0 ? 1.0 : 25.0);
    EXPECT_NEAR(two.log_average_cd_m2(), 5.0, 1e-3);
    EXPECT_NEAR(two.mean_cd_m2(), 13.0, 1e-12);
    // Three quarters black space, a quarter sunlit Earth.
    LuminanceMean orbit;
    orbit.add(4000.0, 1.0);
    orbit.add(0.0, 3.0);
    EXPECT_NEAR(orbit.log_average_cd_m2(), 1000.0 / 3.0, 1e-9);
}

TEST(Adaptation, AFewBrightDirectionsAreNotTheBrightPart) {
    std::array<double, kProbeCount> luminances{};
    luminances.fill(3000.0);
    for (std::size_t i = 0; i < 6; ++i)
        luminances[12 * i] = 2e5;
    luminances[1] = std::nan("");
    EXPECT_DOUBLE_EQ(bright_part_cd_m2(luminances), 3000.0);
    for (std::size_t i = 30; i < 40; ++i)
        luminances[i] = 20000.0;
    EXPECT_DOUBLE_EQ(bright_part_cd_m2(luminances), 20000.0);
}

TEST(Adaptation, ProbesOfAViewStandForAllOfIt) {
    ChannelView view;
    view.frustum = {-0.9, 0.3, -0.4, 0.8};
    double whole = 0.0;
    for (const ViewProbe& probe : view_probes(view)) {
        EXPECT_NEAR(glm::length(probe.direction_enu), 1.0, 1e-12);
        EXPECT_GT(probe.solid_angle_sr, 0.0);
        whole += probe.solid_angle_sr;
    }
    // Of a rectangle at distance 1 from its foot: atan(x y / sqrt(1 + x^2 + y^2)) from the foot to a corner.
    const ImagePlane p = image_plane(view.frustum);
    const auto corner = [](double x, double y) { return std::atan(x * y / std::sqrt(1.0 + x * x + y * y)); };
    const double exact =
        corner(p.right, p.top) - corner(p.left, p.top) - corner(p.right, p.bottom) + corner(p.left, p.bottom);
    EXPECT_NEAR(whole / exact, 1.0, 0.01);
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
