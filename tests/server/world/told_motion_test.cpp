// Motion by told rates against closed forms and against steps taken here.
#include "server/world/told_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace skyig::server::world {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ToldMotion velocity(RateAxes axes, const glm::dvec3& linear, const glm::dvec3& angular_deg_s = {}) {
    ToldMotion motion;
    EXPECT_TRUE(motion.tell_velocity(axes, {linear, angular_deg_s * kRad}));
    return motion;
}

double apart_m(const ephemeris::Geodetic& a, const ephemeris::Geodetic& b) {
    return glm::distance(ecef_of(a), ecef_of(b));
}

void expect_within(double error, double bound, const char* what) {
    std::printf("  %-44s %.3g\n", what, error);
    EXPECT_LE(error, bound) << what;
}

TEST(ToldMotion, LevelTurnClosesItsCircle) {
    const ToldMotion turn = velocity(RateAxes::kOwn, {120.0, 0.0, 0.0}, {0.0, 0.0, 36.0});
    const Pose start{{47.0, 8.0, 2000.0}, 30.0};
    const Pose half = turn.after(start, 5.0);
    // Half a circle away: its diameter.
    expect_within(std::abs(apart_m(start.position, half.position) - 2.0 * 120.0 / (36.0 * kRad)), 0.03,
                  "diameter, m (0.02 is the Earth's bend)");
    EXPECT_NEAR(std::remainder(half.yaw_deg - 210.0, 360.0), 0.0, 0.01);
    const Pose round = turn.after(start, 10.0);
    expect_within(apart_m(start.position, round.position), 1e-3, "circle does not close, m");
    EXPECT_NEAR(std::remainder(round.yaw_deg - 30.0, 360.0), 0.0, 1e-6);
    EXPECT_NEAR(round.position.height_m, 2000.0, 1e-6);
}

TEST(ToldMotion, VelocityOverTheGroundIsThatOfTheEllipsoid) {
    constexpr double kA = 6378137.0;
    constexpr double kF = 1.0 / 298.257223563;
    constexpr double kE2 = kF * (2.0 - kF);
    const glm::dvec3 ned_m_s{180.0, -170.0, 5.0};
    const ToldMotion motion = velocity(RateAxes::kGround, ned_m_s);
    double worst_m = 0.0;
    for (const double latitude : {-60.0, 0.0, 47.0, 70.0}) {
        ephemeris::Geodetic here{latitude, 179.999, 8000.0};
        const Pose there = motion.after({here}, 10.0);
        // Small steps with the radii of curvature of each place.
        for (int i = 0; i < 10'000; ++i) {
            const double sine = std::sin(here.latitude_deg * kRad);
            const double w = 1.0 - kE2 * sine * sine;
            const double meridian_m = kA * (1.0 - kE2) / std::pow(w, 1.5) + here.height_m;
            const double normal_m = kA / std::sqrt(w) + here.height_m;
            here.latitude_deg += ned_m_s.x * 1e-3 / meridian_m / kRad;
            here.longitude_deg += ned_m_s.y * 1e-3 / (normal_m * std::cos(here.latitude_deg * kRad)) / kRad;
            here.height_m -= ned_m_s.z * 1e-3;
        }
        worst_m = std::max(worst_m, apart_m(here, there.position));
        EXPECT_NEAR(there.position.height_m, 7950.0, 1e-9);
    }
    expect_within(worst_m, 1.0, "2.5 km at 70 deg: bend of the geodesic, m");
}

TEST(ToldMotion, AccelerationAddsUpAndMayBeCutInPieces) {
    ToldMotion motion = velocity(RateAxes::kOwn, {50.0, 0.0, 0.0}, {5.0, 0.0, 10.0});
    ASSERT_TRUE(motion.tell_acceleration(RateAxes::kOwn, {{4.0, 0.0, -1.0}, {}}));
    const Pose start{{10.0, 20.0, 3000.0}, 90.0, 5.0, 0.0};
    const Pose whole = motion.after(start, 4.0);
    Pose step = start;
    ToldMotion then = motion;
    for (int i = 0; i < 400; ++i) {
        step = then.after(step, 0.01);
        then = then.later(0.01);
    }
    expect_within(apart_m(whole.position, step.position), 2e-3, "one step against 400, m");
    EXPECT_NEAR(whole.pitch_deg, step.pitch_deg, 1e-3);
    EXPECT_NEAR(whole.roll_deg, step.roll_deg, 1e-3);
    // Straight ahead it is the closed form.
    ToldMotion straight = velocity(RateAxes::kGround, {0.0, 0.0, -10.0});
    ASSERT_TRUE(straight.tell_acceleration(RateAxes::kGround, {{0.0, 0.0, -2.0}, {0.0, 0.0, 3.0 * kRad}}));
    const Pose up = straight.after(start, 6.0);
    EXPECT_NEAR(up.position.height_m, 3000.0 + 60.0 + 36.0, 1e-9);
    EXPECT_NEAR(up.yaw_deg, 90.0 + 54.0, 1e-9);
    EXPECT_EQ(up.position.latitude_deg, start.position.latitude_deg);
}

TEST(ToldMotion, AnglesTurnAsTheirAxesSay) {
    const Pose banked{{0.0, 0.0, 0.0}, 40.0, 20.0, 90.0};
    const Pose ground = velocity(RateAxes::kGround, {}, {0.0, 0.0, 10.0}).after(banked, 2.0);
    EXPECT_NEAR(ground.yaw_deg, 60.0, 1e-9);
    EXPECT_NEAR(ground.pitch_deg, 20.0, 1e-9);
    EXPECT_NEAR(ground.roll_deg, 90.0, 1e-9);
    EXPECT_EQ(ground.position, banked.position);
    // On its side, the nose yaws to the ground.
    const Pose own = velocity(RateAxes::kOwn, {}, {0.0, 0.0, 10.0}).after(banked, 2.0);
    EXPECT_NEAR(own.pitch_deg, 0.0, 1e-9);
    EXPECT_NEAR(own.yaw_deg, 40.0, 1e-9);
    // Through the zenith.
    const Pose loop = velocity(RateAxes::kGround, {}, {0.0, 90.0, 0.0}).after({{}, 40.0}, 1.5);
    EXPECT_NEAR(loop.pitch_deg, 45.0, 1e-9);
    EXPECT_NEAR(std::abs(std::remainder(loop.yaw_deg - 220.0, 360.0)), 0.0, 1e-9);
    EXPECT_NEAR(std::abs(loop.roll_deg), 180.0, 1e-9);
}

TEST(ToldMotion, LevelFlightStaysLevelAndCrossesThePole) {
    const ToldMotion ahead = velocity(RateAxes::kOwn, {250.0, 0.0, 0.0});
    const Pose flown = ahead.after({{45.0, 0.0, 10'000.0}, 90.0}, 10.0);
    EXPECT_NEAR(flown.position.height_m, 10'000.0, 1e-9);
    const Pose start{{89.99, 30.0, 1000.0}};
    const Pose beyond = ahead.after(start, 10.0);
    EXPECT_NEAR(std::remainder(beyond.position.longitude_deg + 150.0, 360.0), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(std::remainder(beyond.yaw_deg, 360.0)), 180.0, 1e-6) << "ahead is south now";
    EXPECT_NEAR(apart_m(start.position, beyond.position), 2500.0, 1.0);
    const Pose held = velocity(RateAxes::kGround, {0.0, 0.0, 10'000.0}).after(start, 10.0);
    EXPECT_EQ(held.position.height_m, ephemeris::kMinEyeHeight_m);
}

TEST(ToldMotion, CostOfAFrame) {
    const ToldMotion turn = velocity(RateAxes::kOwn, {120.0, 0.0, 0.0}, {2.0, 1.0, 3.0});
    const Pose start{{47.0, 8.0, 2000.0}, 30.0};
    double least_us = 1e9;
    double sum_m = 0.0;
    for (int round = 0; round < 20; ++round) {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 1; i <= 500; ++i)
            sum_m += turn.after(start, 0.02 * i).position.height_m;
        const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
        least_us = std::min(least_us, took.count() / 500.0);
    }
    std::printf("  %.2f us a frame, up to 10 s after it was told\n", least_us);
    EXPECT_GT(sum_m, 0.0);
    EXPECT_LT(least_us, 200.0);
}

TEST(ToldMotion, WhatNoCraftDoesIsRefused) {
    ToldMotion motion = velocity(RateAxes::kOwn, {1.0, 0.0, 0.0});
    const ToldMotion before = motion;
    EXPECT_FALSE(motion.tell_velocity(RateAxes::kOwn, {{13'000.0, 0.0, 0.0}, {}}));
    EXPECT_FALSE(motion.tell_velocity(RateAxes::kGround, {{}, {0.0, 0.0, 16.0}}));
    EXPECT_FALSE(motion.tell_velocity(RateAxes::kGround, {{kNan, 0.0, 0.0}, {}}));
    EXPECT_FALSE(motion.tell_acceleration(RateAxes::kOwn, {{1e30, 0.0, 0.0}, {}}));
    EXPECT_FALSE(motion.tell_acceleration(RateAxes::kOwn, {{}, {0.0, kNan, 0.0}}));
    EXPECT_TRUE(motion == before);
    ASSERT_TRUE(motion.tell_acceleration(RateAxes::kOwn, {{900.0, 0.0, 0.0}, {90.0, 0.0, 0.0}}));
    for (int i = 0; i < 1000; ++i)
        motion = motion.later(10.0);
    const Pose pose = motion.after({{0.0, 0.0, 0.0}}, 10.0);
    EXPECT_TRUE(ephemeris::is_valid(pose.position));
    EXPECT_TRUE(std::isfinite(pose.yaw_deg) && std::isfinite(pose.pitch_deg) && std::isfinite(pose.roll_deg));
}

}  // namespace
}  // namespace skyig::server::world
