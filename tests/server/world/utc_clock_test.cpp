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

}  // namespace
}  // namespace skyig::server::world
