#include "server/world/utc_clock.h"

#include <gtest/gtest.h>

namespace skyig::server::world {
namespace {

using protocol::cigi::CelestialSphereControl;

ephemeris::UtcClockTime utc(const char* text) {
    return ephemeris::parse_utc(text).value();
}

CelestialSphereControl setting(int hour, int minute, bool running, bool valid = true) {
    CelestialSphereControl control;
    control.hour = static_cast<std::uint8_t>(hour);
    control.minute = static_cast<std::uint8_t>(minute);
    control.date = 6212026;
    control.ephemeris_enable = running;
    control.date_time_valid = valid;
    return control;
}

double seconds_to(const UtcClock& clock, const char* text) {
    return ephemeris::seconds_between(clock.utc(), utc(text));
}

TEST(UtcClock, RunsOrStandsAsConfigured) {
    UtcClock running(utc("2026-01-01T00:00:00Z"), true), frozen(utc("2026-01-01T00:00:00Z"), false);
    running.advance(90.0);
    frozen.advance(90.0);
    EXPECT_NEAR(seconds_to(running, "2026-01-01T00:01:30Z"), 0.0, 1e-9);
    EXPECT_EQ(seconds_to(frozen, "2026-01-01T00:00:00Z"), 0.0);
}

TEST(UtcClock, HostSetsItAndItRunsOn) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), false);
    EXPECT_TRUE(clock.apply(setting(19, 30, true)));
    clock.advance(30.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:30Z"), 0.0, 1e-9);
}

TEST(UtcClock, RepeatedSettingWhileRunningIsNone) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    for (int frame = 0; frame < 600; ++frame) {
        EXPECT_TRUE(clock.apply(setting(19, 30, true)));
        clock.advance(0.1);
    }
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:31:00Z"), 0.0, 1e-6);
    EXPECT_TRUE(clock.apply(setting(19, 31, true)));
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:31:00Z"), 0.0, 1e-9);
}

TEST(UtcClock, RepeatedSettingWhileFrozenHoldsIt) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    EXPECT_TRUE(clock.apply(setting(19, 30, true)));
    clock.advance(40.0);
    EXPECT_TRUE(clock.apply(setting(19, 30, false)));
    clock.advance(40.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:00Z"), 0.0, 1e-9);
}

/// Frames of a host that says the same date and time in each.
void repeat(UtcClock& clock, const CelestialSphereControl& control, double seconds) {
    constexpr double kFrame_s = 0.125;
    for (double time_s = 0.0; time_s < seconds; time_s += kFrame_s) {
        EXPECT_TRUE(clock.apply(control));
        clock.advance(kFrame_s);
    }
}

TEST(UtcClock, HostThatAlwaysRepeatsItsDateFreezesAndResumesWhereItStands) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    repeat(clock, setting(19, 30, true), 40.0);
    repeat(clock, setting(19, 30, false), 600.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:40Z"), 0.0, 1e-9);
    repeat(clock, setting(19, 30, true), 5.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:45Z"), 0.0, 1e-9);
    // Silent while frozen: it is still the same host.
    EXPECT_TRUE(clock.apply(setting(19, 30, false)));
    clock.advance(3600.0);
    repeat(clock, setting(19, 30, true), 5.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:50Z"), 0.0, 1e-9);
    // Another date is one, frozen or not.
    repeat(clock, setting(4, 15, false), 5.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T04:15:00Z"), 0.0, 1e-9);
}

TEST(UtcClock, HostThatSaysItsMinuteFreezesWithinIt) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    repeat(clock, setting(19, 30, true), 60.0);
    repeat(clock, setting(19, 31, true), 12.0);
    repeat(clock, setting(19, 31, false), 30.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:31:12Z"), 0.0, 1e-9);
}

TEST(UtcClock, SameDateAgainFromAHostThatHadFallenSilentIsASetting) {
    // Three times for a lossy network, then not again until the exercise starts anew.
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    repeat(clock, setting(19, 30, true), 0.375);
    clock.advance(600.0);
    EXPECT_TRUE(clock.apply(setting(19, 30, false)));
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:00Z"), 0.0, 1e-9);
}

TEST(UtcClock, SameDateAfterNoneWasValidIsASetting) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    repeat(clock, setting(19, 30, true), 1.0);
    repeat(clock, setting(0, 0, true, false), 600.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:40:01Z"), 0.0, 1e-9);
    EXPECT_TRUE(clock.apply(setting(19, 30, true)));
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:00Z"), 0.0, 1e-9);
}

TEST(UtcClock, FreezeWithoutDateHoldsTheMomentAndResumeGoesOnFromIt) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    EXPECT_TRUE(clock.apply(setting(19, 30, true)));
    clock.advance(40.0);
    EXPECT_TRUE(clock.apply(setting(0, 0, false, false)));
    clock.advance(1000.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:40Z"), 0.0, 1e-9);
    EXPECT_TRUE(clock.apply(setting(0, 0, true, false)));
    clock.advance(5.0);
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:45Z"), 0.0, 1e-9);
}

TEST(UtcClock, SecondsOfCigi4Count) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    CelestialSphereControl control = setting(19, 30, true);
    control.seconds = 12.5F;
    EXPECT_TRUE(clock.apply(control));
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:12.5Z"), 0.0, 1e-9);
    control.seconds = 13.5F;
    EXPECT_TRUE(clock.apply(control));
    EXPECT_NEAR(seconds_to(clock, "2026-06-21T19:30:13.5Z"), 0.0, 1e-9);
}

TEST(UtcClock, ImpossibleDateChangesNothing) {
    UtcClock clock(utc("2020-01-01T00:00:00Z"), true);
    CelestialSphereControl control = setting(19, 30, true);
    control.date = 13322026;
    EXPECT_FALSE(clock.apply(control));
    EXPECT_EQ(seconds_to(clock, "2020-01-01T00:00:00Z"), 0.0);
}

TEST(UtcClockRate, IsTheBussUntilAHostSetsTheClock) {
    const auto start = *ephemeris::parse_utc("2026-06-21T12:00:00Z");
    UtcClock clock(start, 10.0);
    clock.advance(6.0);
    EXPECT_EQ(ephemeris::to_iso(clock.utc()), "2026-06-21T12:01:00Z");
    protocol::cigi::CelestialSphereControl control;
    control.ephemeris_enable = true;
    ASSERT_TRUE(clock.apply(control));
    clock.advance(6.0);
    EXPECT_EQ(ephemeris::to_iso(clock.utc()), "2026-06-21T12:01:06Z");
    UtcClock frozen(start, 0.0);
    frozen.advance(6.0);
    EXPECT_FALSE(frozen.running());
    EXPECT_EQ(frozen.utc(), start);
}

}  // namespace
}  // namespace skyig::server::world
