// The ownship between reports: nearer to the truth than holding it, exact where it must not move, never wild.
#include "server/world/ownship_track.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <GeographicLib/Geocentric.hpp>
#include <limits>
#include <random>

#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

double distance_m(const ephemeris::Geodetic& a, const ephemeris::Geodetic& b) {
    const auto& earth = GeographicLib::Geocentric::WGS84();
    double ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0;
    earth.Forward(a.latitude_deg, a.longitude_deg, a.height_m, ax, ay, az);
    earth.Forward(b.latitude_deg, b.longitude_deg, b.height_m, bx, by, bz);
    return std::hypot(ax - bx, ay - by, az - bz);
}

double turn_deg(const Pose& a, const Pose& b) {
    const glm::dquat d = glm::conjugate(ned_from_body(a.yaw_deg, a.pitch_deg, a.roll_deg)) *
                         ned_from_body(b.yaw_deg, b.pitch_deg, b.roll_deg);
    return 2.0 * std::atan2(std::hypot(d.x, d.y, d.z), std::abs(d.w)) * 57.29577951308232;
}

/// A level turn of 3 deg/s at 120 m/s, from the west across the antimeridian.
Pose turning(double time_s) {
    const double radius_m = 120.0 / (3.0 / 57.29577951308232);
    const double heading = (90.0 + 3.0 * time_s) / 57.29577951308232;
    const double north_m = radius_m * std::sin(heading - 1.5707963267948966);
    const double east_m = radius_m * (1.0 - std::cos(heading - 1.5707963267948966));
    Pose pose;
    pose.position = {10.0 - east_m / 110600.0, 179.99 + north_m / 109600.0, 3000.0};
    if (pose.position.longitude_deg > 180.0) pose.position.longitude_deg -= 360.0;
    pose.yaw_deg = std::fmod(90.0 + 3.0 * time_s, 360.0);
    pose.roll_deg = 32.0;
    pose.pitch_deg = 2.0;
    return pose;
}

struct Errors {
    double carried_m = 0.0;
    double held_m = 0.0;
    double carried_deg = 0.0;
    double held_deg = 0.0;
};

/// 20 reports a second with 0..15 ms of delay, seen by 60 frames a second for 30 s.
Errors fly() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> delay(0.0, 0.015);
    OwnshipTrack track;
    Errors errors;
    Pose held;
    double next_report_s = 0.0;
    double arrives_s = 0.004;
    for (int frame = 0; frame < 1800; ++frame) {
        const double now_s = 100.0 + frame / 60.0;
        while (100.0 + arrives_s <= now_s) {
            held = turning(next_report_s);
            track.report_position(held.position, now_s, next_report_s);
            track.report_attitude(held.yaw_deg, held.pitch_deg, held.roll_deg, now_s, next_report_s);
            next_report_s += 0.0503;
            arrives_s = next_report_s + delay(random);
        }
        if (frame < 120) continue;
        // The least delay is a matter of the link; what is judged is the motion between reports.
        const Pose truth = turning(frame / 60.0);
        const Pose carried = track.at(now_s);
        errors.carried_m = std::max(errors.carried_m, distance_m(carried.position, truth.position));
        errors.held_m = std::max(errors.held_m, distance_m(held.position, truth.position));
        errors.carried_deg = std::max(errors.carried_deg, turn_deg(carried, truth));
        errors.held_deg = std::max(errors.held_deg, turn_deg(held, truth));
    }
    return errors;
}

TEST(OwnshipTrack, StampedReportsAreCarriedOnThroughATurn) {
    const Errors errors = fly();
    std::printf(
        "  20 Hz with 15 ms of jitter, 120 m/s, 3 deg/s: carried %.2f m %.3f deg, held %.2f m %.3f deg\n",
        errors.carried_m, errors.carried_deg, errors.held_m, errors.held_deg);
    EXPECT_LT(errors.carried_m, 1.0);
    EXPECT_GT(errors.held_m, 5.0);
    EXPECT_LT(errors.carried_deg, 0.03);
    EXPECT_GT(errors.held_deg, 0.1);
}

TEST(OwnshipTrack, ReportsWithoutStampAreHeldBitForBit) {
    OwnshipTrack track;
    for (int i = 0; i < 10; ++i) {
        const Pose pose = turning(0.05 * i);
        track.report_position(pose.position, 0.05 * i, std::nullopt);
        track.report_attitude(pose.yaw_deg, pose.pitch_deg, pose.roll_deg, 0.05 * i, std::nullopt);
        EXPECT_EQ(track.at(0.05 * i + 0.04), pose);
    }
}

TEST(OwnshipTrack, CraftThatStandsStillStaysBitForBit) {
    OwnshipTrack track;
    const Pose pose{{47.1234567, 8.7654321, 432.1}, 271.0, 0.5, 0.0};
    for (int i = 0; i < 10; ++i) {
        track.report_position(pose.position, 0.1 * i, 0.1 * i);
        track.report_attitude(pose.yaw_deg, pose.pitch_deg, pose.roll_deg, 0.1 * i, 0.1 * i);
        EXPECT_EQ(track.at(0.1 * i + 0.07), pose);
    }
}

TEST(OwnshipTrack, SilenceIsBridgedForASecondThenHeld) {
    OwnshipTrack track;
    track.report_position({0.0, 0.0, 0.0}, 0.0, 0.0);
    track.report_position({0.0, 0.0001, 0.0}, 0.1, 0.1);
    const double step_m = distance_m({0.0, 0.0, 0.0}, {0.0, 0.0001, 0.0});
    EXPECT_NEAR(distance_m(track.at(0.6).position, {0.0, 0.0001, 0.0}), 5.0 * step_m, 0.01);
    EXPECT_EQ(track.at(2.0), track.at(100.0));
    EXPECT_NEAR(distance_m(track.at(100.0).position, {0.0, 0.0001, 0.0}), 10.0 * step_m, 0.01);
}

TEST(OwnshipTrack, RepositionAndRestartOfTheSenderMakeNoMotion) {
    OwnshipTrack track;
    track.report_position({0.0, 0.0, 0.0}, 0.0, 0.0);
    track.report_position({40.0, 90.0, 0.0}, 0.1, 0.1);
    EXPECT_EQ(track.at(0.5).position, (ephemeris::Geodetic{40.0, 90.0, 0.0}));
    // The sender's clock begins anew; then it goes on from there.
    track.report_position({40.0, 90.0001, 0.0}, 0.2, -5000.0);
    EXPECT_EQ(track.at(0.5).position, (ephemeris::Geodetic{40.0, 90.0001, 0.0}));
    track.report_position({40.0, 90.0002, 0.0}, 0.3, -4999.9);
    EXPECT_GT(track.at(0.5).position.longitude_deg, 90.0002);
    // A message that was overtaken on the way.
    track.report_position({40.0, 90.0001, 0.0}, 0.4, -4999.95);
    EXPECT_EQ(track.at(0.5).position, (ephemeris::Geodetic{40.0, 90.0001, 0.0}));
}

TEST(OwnshipTrack, PolesVerticalNoseAndWrapOfYawAreCrossedSmoothly) {
    OwnshipTrack track;
    track.report_position({89.9999, 30.0, 1000.0}, 0.0, 0.0);
    track.report_position({89.99999, 30.0, 1000.0}, 0.1, 0.1);
    const Pose beyond = track.at(0.3);
    EXPECT_NEAR(beyond.position.longitude_deg, -150.0, 1e-6);
    EXPECT_NEAR(beyond.position.latitude_deg, 90.0 - 1.7e-4, 2e-6);
    for (const double pitch : {89.0, 90.0}) {
        track.report_attitude(358.0, pitch - 1.0, 0.0, 1.0, 1.0);
        track.report_attitude(359.0, pitch, 0.0, 1.1, 1.1);
        const Pose pose = track.at(1.2);
        EXPECT_TRUE(std::isfinite(pose.yaw_deg) && std::isfinite(pose.roll_deg));
        EXPECT_LT(turn_deg(pose, {{}, 359.0, pitch, 0.0}), 1.5);
    }
    track.report_attitude(359.0, 0.0, 0.0, 2.0, 2.0);
    track.report_attitude(1.0, 0.0, 0.0, 2.1, 2.1);
    EXPECT_LT(turn_deg(track.at(2.15), {{}, 2.0, 0.0, 0.0}), 1e-9);
}

TEST(OwnshipTrack, ToldVelocityCarriesReportsWithoutStamp) {
    OwnshipTrack track;
    track.report_position({0.0, 0.0, 100.0}, 10.0, std::nullopt);
    track.report_velocity({111.31949, 0.0, 10.0}, 10.0);
    const Pose pose = track.at(10.5);
    EXPECT_NEAR(pose.position.longitude_deg, 0.0005, 2e-8);
    EXPECT_NEAR(pose.position.height_m, 105.0, 1e-3);
}

TEST(OwnshipTrack, VelocityThatIsNoLongerToldIsNoLongerUsed) {
    OwnshipTrack track;
    track.report_position({0.0, 0.0, 0.0}, 0.0, 0.0);
    track.report_velocity({100.0, 0.0, 0.0}, 0.0);
    // The craft stands; its velocity was told once and never again.
    for (int i = 1; i <= 40; ++i)
        track.report_position({0.0, 0.0, 0.0}, 0.05 * i, 0.05 * i);
    EXPECT_EQ(track.at(2.04).position, (ephemeris::Geodetic{0.0, 0.0, 0.0}));
}

/// Northward over the ground.
Rates north(double speed_m_s) {
    return {{speed_m_s, 0.0, 0.0}, {}};
}

TEST(OwnshipTrack, ToldRatesComeBeforeWhatReportsSay) {
    OwnshipTrack track;
    track.carry_told(true, 0.0);
    // Reports that say east, and a host that says north.
    track.report_position({0.0, 0.0, 0.0}, 0.0, 0.0);
    track.report_position({0.0, 0.001, 0.0}, 0.1, 0.1);
    ASSERT_TRUE(track.tell_velocity(RateAxes::kGround, north(100.0), 0.1, 0.1));
    const Pose pose = track.at(0.6);
    EXPECT_EQ(pose.position.longitude_deg, 0.001);
    EXPECT_NEAR(distance_m({0.0, 0.001, 0.0}, pose.position), 50.0, 1e-6);
    // A report moves it and leaves the rates.
    track.report_position({10.0, 0.0, 0.0}, 1.1, 1.1);
    EXPECT_NEAR(distance_m({10.0, 0.0, 0.0}, track.at(2.1).position), 100.0, 1e-6);
    // They hold for as long as nothing else is told: half a minute, in frames.
    for (int i = 0; i <= 600; ++i)
        track.advance(1.1 + 0.05 * i);
    EXPECT_NEAR(distance_m({10.0, 0.0, 0.0}, track.at(31.1).position), 3000.0, 0.01);
}

TEST(OwnshipTrack, ToldRatesHoldFromTheStampNotFromTheArrival) {
    OwnshipTrack track;
    track.carry_told(true, 10.0);
    track.report_position({0.0, 0.0, 0.0}, 10.0, 0.0);
    track.report_position({0.0, 0.0, 0.0}, 10.1, 0.1);
    // 40 ms late on the way.
    ASSERT_TRUE(track.tell_velocity(RateAxes::kGround, north(100.0), 10.24, 0.2));
    EXPECT_NEAR(distance_m({0.0, 0.0, 0.0}, track.at(10.24).position), 4.0, 0.01);
    // Without stamp, from the arrival.
    ASSERT_TRUE(track.tell_velocity(RateAxes::kGround, north(0.0), 10.30, std::nullopt));
    EXPECT_NEAR(distance_m({0.0, 0.0, 0.0}, track.at(99.0).position), 10.0, 0.01);
}

// A host that has placed its craft once and then tells rates alone, by a clock that the track cannot learn.
struct RatesAlone {
    RatesAlone() {
        track.report_position({0.0, 0.0, 1000.0}, 0.0, 0.0);
        track.carry_told(true, 0.0);
    }
    void tell(double north_m_s, double arrival_s, double sender_s) {
        EXPECT_TRUE(track.tell_velocity(RateAxes::kGround, {{north_m_s, 0.0, 0.0}, {}}, arrival_s, sender_s));
    }
    [[nodiscard]] double north_m(double now_s) {
        track.advance(now_s);
        return track.at(now_s).position.latitude_deg * 110'574.3;
    }
    OwnshipTrack track;
};

TEST(OwnshipTrack, RatesAloneFollowASendersClockThatDrifts) {
    RatesAlone host;
    double largest_m = 0.0;
    for (int minute = 1; minute <= 60; ++minute) {
        const double now_s = 60.0 * minute;
        host.tell(minute % 2 == 0 ? -250.0 : 250.0, now_s, now_s * 1.0002);
        // Stood in the first minute, then flies there and back.
        const double wanted_m = minute % 2 == 0 ? 15'000.0 : 0.0;
        largest_m = std::max(largest_m, std::abs(host.north_m(now_s) - wanted_m));
        for (int second = 1; second < 60; second += 5)
            (void)host.north_m(now_s + second);
    }
    std::printf("largest error of rates alone by a clock 200 ppm fast: %.1f m\n", largest_m);
    EXPECT_LT(largest_m, 60.0);
}

TEST(OwnshipTrack, RatesAloneSurviveAJumpOfTheSendersClock) {
    for (const double jump_s : {3600.0, -3600.0}) {
        for (const bool moving : {false, true}) {
            RatesAlone host;
            if (moving) host.tell(100.0, 1.0, 1.0);
            host.tell(50.0, 20.0, 20.0 + jump_s);
            const double until_then_m = moving ? 1900.0 : 0.0;
            EXPECT_NEAR(host.north_m(20.0), until_then_m, 1.0) << jump_s << moving;
            EXPECT_NEAR(host.north_m(24.0), until_then_m + 200.0, 1.0) << jump_s << moving;
            host.tell(0.0, 30.0, 30.0 + jump_s);
            EXPECT_NEAR(host.north_m(31.0), until_then_m + 500.0, 1.0) << jump_s << moving;
        }
    }
}

TEST(OwnshipTrack, ZeroRatesLeaveItToTheReportsAgain) {
    OwnshipTrack track;
    track.carry_told(true, 0.0);
    ASSERT_TRUE(track.tell_velocity(RateAxes::kGround, north(100.0), 0.0, 0.0));
    ASSERT_TRUE(track.tell_velocity(RateAxes::kGround, north(0.0), 1.0, 1.0));
    const Pose stood = track.at(1.0);
    EXPECT_EQ(track.at(50.0), stood);
    for (int i = 0; i < 3; ++i) {
        // A host that flies by places and says so in every message.
        ASSERT_TRUE(track.tell_velocity(RateAxes::kGround, north(0.0), 2.0 + 0.1 * i, 2.0 + 0.1 * i));
        track.report_position({1.0, 0.0001 * i, 0.0}, 2.0 + 0.1 * i, 2.0 + 0.1 * i);
    }
    EXPECT_NEAR(track.at(2.3).position.longitude_deg, 0.0003, 1e-9);
}

TEST(OwnshipTrack, ToldRatesThatAreNotCarriedStand) {
    OwnshipTrack track;
    track.report_position({0.0, 0.0, 0.0}, 0.0, std::nullopt);
    ASSERT_TRUE(track.tell_velocity(RateAxes::kGround, north(100.0), 0.0, std::nullopt));
    EXPECT_EQ(track.at(5.0).position, (ephemeris::Geodetic{0.0, 0.0, 0.0}));
    track.carry_told(true, 5.0);
    EXPECT_NEAR(distance_m({0.0, 0.0, 0.0}, track.at(6.0).position), 100.0, 1e-6);
    track.carry_told(false, 7.0);
    EXPECT_NEAR(distance_m({0.0, 0.0, 0.0}, track.at(99.0).position), 200.0, 1e-6);
    EXPECT_FALSE(track.tell_velocity(RateAxes::kGround, north(1e6), 99.0, std::nullopt));
}

TEST(OwnshipTrack, AccelerationChangesTheVelocityThatAReportLeaves) {
    OwnshipTrack track;
    track.carry_told(true, 0.0);
    ASSERT_TRUE(track.tell_acceleration(RateAxes::kGround, north(10.0), 0.0, 0.0));
    EXPECT_NEAR(distance_m({0.0, 0.0, 0.0}, track.at(2.0).position), 20.0, 1e-6);
    track.report_position({0.0, 50.0, 0.0}, 2.0, 2.0);
    // 20 m/s by now.
    EXPECT_NEAR(distance_m({0.0, 50.0, 0.0}, track.at(3.0).position), 25.0, 1e-6);
}

TEST(StampClock, DifferencesSurviveTheWrapAndABackwardStep) {
    StampClock clock;
    EXPECT_EQ(clock.seconds(0xFFFFFF00U), 0.0);
    EXPECT_NEAR(clock.seconds(0x00000100U), 512e-5, 1e-12);
    EXPECT_NEAR(clock.seconds(0x00000000U), 256e-5, 1e-12);
}

// The gates of CIGI: both smoothing bits and a valid time stamp, or the position is held.
class Smoothing : public ::testing::Test {
  protected:
    /// Two positions a tenth of a second apart, then half a second without any. \return longitude drawn
    double fly(bool stamp, bool gate, bool entity) {
        for (int i = 0; i < 2; ++i) {
            protocol::cigi::IgControl control;
            control.ig_mode = protocol::cigi::IgMode::kOperate;
            control.host_frame_number = ++bench_.frame;
            control.timestamp_valid = stamp;
            control.timestamp = 10'000U * static_cast<std::uint32_t>(i);
            control.extrapolation_enable = gate;
            protocol::cigi::EntityControl ownship;
            ownship.entity_state = protocol::cigi::EntityState::kActive;
            ownship.extrapolation_enable = entity;
            ownship.lon_y = 0.001 * i;
            bench_.send_as(kHostA, control, ownship);
            bench_.world.advance(0.1);
        }
        for (int i = 0; i < 5; ++i)
            bench_.world.advance(0.1);
        return bench_.world.ownship().position.longitude_deg;
    }

    HostBench bench_;
};

TEST_F(Smoothing, BothBitsAndAStampCarryOn) {
    EXPECT_NEAR(fly(true, true, true), 0.001 + 5 * 0.001, 1e-6);
}
TEST_F(Smoothing, WithoutStampItIsHeld) {
    EXPECT_EQ(fly(false, true, true), 0.001);
}
TEST_F(Smoothing, WithoutTheGateItIsHeld) {
    EXPECT_EQ(fly(true, false, true), 0.001);
}
TEST_F(Smoothing, WithoutTheEntitysBitItIsHeld) {
    EXPECT_EQ(fly(true, true, false), 0.001);
}

}  // namespace
}  // namespace skyig::server::world
