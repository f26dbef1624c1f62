// The cached sky against the computed one: same place, whatever way the clock runs, without allocation, and
// its price.
#include "server/ephemeris/sky_clockwork.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string_view>

#include "tests/server/ephemeris/truth.h"
#include "tests/support/allocation_count.h"

namespace skyig::server::ephemeris {
namespace {

using tests::separation_arcsec;

constexpr Geodetic kEye{52.0, 13.0, 11000.0};

UtcClockTime clock_at(std::string_view utc) {
    return parse_utc(utc).value();
}

double largest_difference_arcsec(const SkyState& a, const SkyState& b) {
    double star_arcsec = 0.0;
    for (glm::length_t column = 0; column < 3; ++column)
        star_arcsec =
            std::max(star_arcsec, separation_arcsec(a.enu_from_gcrs[column], b.enu_from_gcrs[column]));
    return std::max({star_arcsec, separation_arcsec(a.sun.direction_enu, b.sun.direction_enu),
                     separation_arcsec(a.moon.direction_enu, b.moon.direction_enu),
                     separation_arcsec(a.moon.to_sun_enu, b.moon.to_sun_enu),
                     glm::length(a.earth_velocity_c - b.earth_velocity_c) * tests::kArcsecPerRad});
}

bool same(const SkyState& a, const SkyState& b) {
    return a.sun.direction_enu == b.sun.direction_enu && a.moon.direction_enu == b.moon.direction_enu &&
           a.moon.to_sun_enu == b.moon.to_sun_enu && a.enu_from_gcrs == b.enu_from_gcrs &&
           a.earth_velocity_c == b.earth_velocity_c && a.sun.obscured == b.sun.obscured;
}

TEST(SkyClockwork, AddsLessThanATenThousandthOfAnArcsecond) {
    SkyClockwork clockwork;
    double largest_arcsec = 0.0;
    double largest_moon_km = 0.0;
    for (const std::string_view start :
         {"1900-01-01T00:00:00Z", "1972-06-30T22:00:00Z", "2026-06-21T00:00:00Z", "2016-12-31T12:00:00Z",
          "2100-12-28T00:00:00Z"}) {
        UtcClockTime time = clock_at(start);
        for (int step = 0; step < 1000; ++step) {
            const Instant instant = make_instant(time);
            const SkyState cached = clockwork.state(instant, kEye);
            const SkyState computed = compute_sky_state(instant, kEye);
            largest_arcsec = std::max(largest_arcsec, largest_difference_arcsec(cached, computed));
            largest_moon_km =
                std::max(largest_moon_km, std::abs(cached.moon.distance_km - computed.moon.distance_km));
            time.advance(97.3);
        }
    }
    std::printf("cache against series, 5 x 1000 instants: max %.6f arcsec, Moon's distance %.4f km\n",
                largest_arcsec, largest_moon_km);
    EXPECT_LE(largest_arcsec, 0.0001);
    EXPECT_LE(largest_moon_km, 0.01);
}

TEST(SkyClockwork, DependsOnTheInstantAloneWhateverWayTheClockRuns) {
    constexpr std::array kJumps_s{30.0,    60.0,     -60.0, -30.0, 59.999, -120.0,
                                  86400.0, -86400.0, 0.0,   3e9,   -3e9,   1.0};
    SkyClockwork clockwork;
    UtcClockTime time = clock_at("2026-06-21T12:00:00Z");
    for (int round = 0; round < 20; ++round) {
        for (const double jump_s : kJumps_s) {
            time.advance(jump_s);
            const Instant instant = make_instant(time);
            SkyClockwork fresh;
            EXPECT_TRUE(same(clockwork.state(instant, kEye), fresh.state(instant, kEye))) << to_iso(time, 3);
        }
        time.advance(71.0);
    }
}

TEST(SkyClockwork, RunsBackwardsAsItRanForwards) {
    SkyClockwork clockwork;
    std::array<SkyState, 400> forwards;
    UtcClockTime time = clock_at("2016-12-31T23:00:00Z");
    constexpr double kStep_s = 16.0;
    for (SkyState& state : forwards) {
        state = clockwork.state(make_instant(time), kEye);
        time.advance(kStep_s);
    }
    for (std::size_t i = forwards.size(); i-- > 0;) {
        time.advance(-kStep_s);
        EXPECT_TRUE(same(clockwork.state(make_instant(time), kEye), forwards[i])) << to_iso(time);
    }
}

TEST(SkyClockwork, MovesWithoutAStepFromFrameToFrame) {
    // Two hours of frames of a second across a leap second and a year's end: the Sun turns 15 arcsec a frame,
    // never more.
    SkyClockwork clockwork;
    UtcClockTime time = clock_at("2016-12-31T23:00:00Z");
    SkyState before = clockwork.state(make_instant(time), kEye);
    double least_arcsec = 1e9;
    double largest_arcsec = 0.0;
    for (int frame = 0; frame < 7200; ++frame) {
        time.advance(1.0);
        const SkyState now = clockwork.state(make_instant(time), kEye);
        const double moved_arcsec = separation_arcsec(now.sun.direction_enu, before.sun.direction_enu);
        least_arcsec = std::min(least_arcsec, moved_arcsec);
        largest_arcsec = std::max(largest_arcsec, moved_arcsec);
        before = now;
    }
    std::printf("the Sun moves %.5f..%.5f arcsec a second\n", least_arcsec, largest_arcsec);
    EXPECT_LE(largest_arcsec - least_arcsec, 0.001);
}

TEST(SkyClockwork, EvaluatesTheSeriesAtKnotsOnly) {
    SkyClockwork clockwork;
    UtcClockTime time = clock_at("2026-06-21T12:00:00Z");
    for (int frame = 0; frame < 60 * 3600; ++frame) {
        const SkyState state = clockwork.state(make_instant(time), kEye);
        ASSERT_TRUE(state.eye_accepted);
        time.advance(1.0 / 60.0);
    }
    // An hour has sixty intervals, sixty-one when it begins inside one, and one knot more than intervals.
    EXPECT_LE(clockwork.evaluations(), 62U);
}

TEST(SkyClockwork, TakesAnInstantThatIsNoneForTheDefault) {
    SkyClockwork clockwork;
    const SkyState expected = compute_sky_state(Instant{}, kEye);
    for (const double fraction :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
        Instant instant;
        instant.tt.fraction = fraction;
        EXPECT_TRUE(same(clockwork.state(instant, kEye), expected));
    }
}

TEST(SkyClockwork, AllocatesNothing) {
    SkyClockwork clockwork;
    UtcClockTime time = clock_at("2016-12-31T23:55:00Z");
    const std::uint64_t before = skyig::tests::allocation_count();
    double sum = 0.0;
    for (int frame = 0; frame < 1000; ++frame) {
        time.advance(1.0);
        sum += clockwork.state(make_instant(time), kEye).sun.direction_enu.z;
    }
    EXPECT_EQ(skyig::tests::allocation_count(), before);
    EXPECT_TRUE(std::isfinite(sum));
}

TEST(SkyClockwork, CostsAboutAMicrosecondAFrame) {
    using Clock = std::chrono::steady_clock;
    SkyClockwork clockwork;
    const auto ns_per_call = [](int calls, auto&& call) {
        double best_ns = 1e30;
        for (int round = 0; round < 5; ++round) {
            const Clock::time_point start = Clock::now();
            for (int i = 0; i < calls; ++i)
                call();
            const std::chrono::duration<double, std::nano> elapsed = Clock::now() - start;
            best_ns = std::min(best_ns, elapsed.count() / calls);
        }
        return best_ns;
    };
    double sum = 0.0;
    UtcClockTime time = clock_at("2026-06-21T12:00:00Z");
    const Instant instant = make_instant(time);
    const double instant_ns = ns_per_call(2000, [&] {
        time.advance(1e-3);
        sum += make_instant(time).tt.fraction;
    });
    const double cached_ns =
        ns_per_call(2000, [&] { sum += clockwork.state(instant, kEye).sun.direction_enu.z; });
    const double computed_ns =
        ns_per_call(50, [&] { sum += compute_sky_state(instant, kEye).sun.direction_enu.z; });
    std::printf("make_instant %.0f ns, SkyClockwork::state %.0f ns, compute_sky_state %.0f ns\n", instant_ns,
                cached_ns, computed_ns);
    RecordProperty("cached_ns", static_cast<int>(cached_ns));
    RecordProperty("computed_ns", static_cast<int>(computed_ns));
    EXPECT_TRUE(std::isfinite(sum));
    // Wide, since the machine may be busy and the build may carry sanitizers: the point is the ratio.
    EXPECT_LE(cached_ns, 0.1 * computed_ns);
}

}  // namespace
}  // namespace skyig::server::ephemeris
