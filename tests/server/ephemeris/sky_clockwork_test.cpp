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
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/truth.h"
#include "tests/support/allocation_count.h"

namespace skyig::server::ephemeris {
namespace {

using tests::separation_arcsec;

constexpr Geodetic kEye{52.0, 13.0, 11000.0};

UtcClockTime clock_at(std::string_view utc) {
    return parse_utc(utc).value();
}

/// How far two states are apart, each kind by its largest.
struct Difference {
    double stars_arcsec = 0.0;
    double sun_moon_arcsec = 0.0;
    double planets_arcsec = 0.0;
    double moon_face_arcsec = 0.0;
    double phases_arcsec = 0.0;
    double moon_km = 0.0;
    double magnitude = 0.0;
    double shadow_moon_radii = 0.0;
    double sunlit = 0.0;

    void add(const SkyState& a, const SkyState& b) {
        using tests::raise;
        for (glm::length_t column = 0; column < 3; ++column) {
            raise(stars_arcsec, separation_arcsec(a.enu_from_gcrs[column], b.enu_from_gcrs[column]));
            raise(stars_arcsec,
                  separation_arcsec(a.true_of_date_from_gcrs[column], b.true_of_date_from_gcrs[column]));
            raise(moon_face_arcsec, separation_arcsec(a.moon.enu_from_selenographic[column],
                                                      b.moon.enu_from_selenographic[column]));
        }
        raise(stars_arcsec, glm::length(a.eye_velocity_c - b.eye_velocity_c) * tests::kArcsecPerRad);
        raise(sun_moon_arcsec, separation_arcsec(a.sun.direction_enu, b.sun.direction_enu));
        raise(sun_moon_arcsec, separation_arcsec(a.moon.direction_enu, b.moon.direction_enu));
        raise(sun_moon_arcsec, separation_arcsec(a.moon.to_sun_enu, b.moon.to_sun_enu));
        raise(moon_km, a.moon.distance_km - b.moon.distance_km);
        raise(magnitude, a.moon.magnitude - b.moon.magnitude);
        // Before the Sun there is no shadow; its axis is then only said to be far.
        if (glm::length(b.moon.shadow_axis_enu) < 100.0)
            raise(shadow_moon_radii, glm::length(a.moon.shadow_axis_enu - b.moon.shadow_axis_enu));
        raise(sunlit, a.moon.sunlit - b.moon.sunlit);
        for (std::size_t i = 0; i < kPlanetCount; ++i) {
            const PlanetState& p = a.planets[i];
            const PlanetState& q = b.planets[i];
            raise(planets_arcsec, separation_arcsec(p.direction_enu, q.direction_enu));
            raise(phases_arcsec, (p.phase_angle_rad - q.phase_angle_rad) * tests::kArcsecPerRad);
            raise(phases_arcsec,
                  std::remainder(p.bright_limb_rad - q.bright_limb_rad, 2.0 * std::numbers::pi) *
                      tests::kArcsecPerRad);
            raise(magnitude, p.magnitude - q.magnitude);
        }
    }
};

bool same(const SkyState& a, const SkyState& b) {
    for (std::size_t i = 0; i < kPlanetCount; ++i) {
        if (a.planets[i].direction_enu != b.planets[i].direction_enu ||
            a.planets[i].magnitude != b.planets[i].magnitude ||
            a.planets[i].bright_limb_rad != b.planets[i].bright_limb_rad)
            return false;
    }
    return a.sun.direction_enu == b.sun.direction_enu && a.moon.direction_enu == b.moon.direction_enu &&
           a.moon.to_sun_enu == b.moon.to_sun_enu &&
           a.moon.enu_from_selenographic == b.moon.enu_from_selenographic && a.moon.sunlit == b.moon.sunlit &&
           a.moon.shadow_axis_enu == b.moon.shadow_axis_enu && a.enu_from_gcrs == b.enu_from_gcrs &&
           a.true_of_date_from_gcrs == b.true_of_date_from_gcrs && a.earth_velocity_c == b.earth_velocity_c &&
           a.sun.obscured == b.sun.obscured;
}

class SkyClockworkOf : public testing::TestWithParam<Model> {};

TEST_P(SkyClockworkOf, AddsLessThanATenThousandthOfAnArcsecond) {
    SkyClockwork clockwork(GetParam());
    EXPECT_EQ(clockwork.model(), GetParam());
    Difference difference;
    std::mt19937_64 random(20260621);
    std::uniform_real_distribution<double> jump_s(0.0, 4.0e6);
    // An hour of the lunar eclipse of 2018-07-27 in small steps, then all of 1900-2100 at random.
    UtcClockTime time = clock_at("2018-07-27T18:20:00Z");
    for (int step = 0; step < 400; ++step) {
        const Instant instant = make_instant(time);
        difference.add(clockwork.state(instant, kEye), compute_sky_state(instant, kEye, GetParam()));
        time.advance(9.73);
    }
    time = clock_at("1900-01-01T00:00:00Z");
    for (int step = 0; step < 3000; ++step) {
        const Instant instant = make_instant(time);
        difference.add(clockwork.state(instant, kEye), compute_sky_state(instant, kEye, GetParam()));
        time.advance(jump_s(random));
    }
    std::printf(
        "%s: cache against theories, 3400 instants to %s: stars %.6f, Sun and Moon %.6f, planets %.6f, face "
        "of the Moon %.6f, phases and limbs %.4f arcsec, Moon %.4f km, magnitude %.6f, shadow %.6f of the "
        "Moon's radius, sunlit %.6f\n",
        std::string(kModelNames[static_cast<std::size_t>(GetParam())]).c_str(), to_iso(time).c_str(),
        difference.stars_arcsec, difference.sun_moon_arcsec, difference.planets_arcsec,
        difference.moon_face_arcsec, difference.phases_arcsec, difference.moon_km, difference.magnitude,
        difference.shadow_moon_radii, difference.sunlit);
    EXPECT_LE(difference.stars_arcsec, 1e-4);
    EXPECT_LE(difference.sun_moon_arcsec, 1e-4);
    EXPECT_LE(difference.planets_arcsec, 1e-4);
    EXPECT_LE(difference.moon_face_arcsec, 0.01);
    EXPECT_LE(difference.phases_arcsec, 0.05);
    EXPECT_LE(difference.moon_km, 0.01);
    EXPECT_LE(difference.magnitude, 1e-4);
    EXPECT_LE(difference.shadow_moon_radii, 1e-4);
    EXPECT_LE(difference.sunlit, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Models, SkyClockworkOf,
                         testing::Values(Model::kAlmanac, Model::kErfa, Model::kSeries), [](const auto& of) {
                             return std::string(kModelNames[static_cast<std::size_t>(of.param)]);
                         });

TEST(SkyClockwork, TakesTheModelItWasBuiltWith) {
    const Instant instant = make_instant(clock_at("2026-06-21T12:00:00Z"));
    SkyClockwork almanac(Model::kAlmanac);
    SkyClockwork series;
    const double apart_arcsec = separation_arcsec(almanac.state(instant, kEye).moon.direction_enu,
                                                  series.state(instant, kEye).moon.direction_enu);
    EXPECT_GT(apart_arcsec, 5.0);
    EXPECT_EQ(series.model(), Model::kSeries);
}

TEST(SkyClockwork, GivesInTwoThreadsWhatItGivesInSequence) {
    constexpr std::size_t kStates = 300;
    const auto run = [](const char* start, std::vector<SkyState>& states) {
        SkyClockwork clockwork;
        UtcClockTime time = clock_at(start);
        for (SkyState& state : states) {
            state = clockwork.state(make_instant(time), kEye);
            time.advance(37.0);
        }
    };
    std::vector<SkyState> a(kStates), b(kStates), a_alone(kStates), b_alone(kStates);
    run("1999-12-31T23:00:00Z", a_alone);
    run("2060-06-30T11:00:00Z", b_alone);
    std::thread first(run, "1999-12-31T23:00:00Z", std::ref(a));
    std::thread second(run, "2060-06-30T11:00:00Z", std::ref(b));
    first.join();
    second.join();
    for (std::size_t i = 0; i < kStates; ++i) {
        EXPECT_TRUE(same(a[i], a_alone[i]));
        EXPECT_TRUE(same(b[i], b_alone[i]));
    }
}

TEST(SkyClockwork, NeverShowsAStaleSkyToANewSite) {
    // Within one interval the eye jumps round the world and into orbit.
    SkyClockwork clockwork;
    const Instant instant = make_instant(clock_at("2026-06-21T12:00:30Z"));
    for (const Geodetic& eye :
         {kEye, Geodetic{-90.0, 0.0, 2800.0}, Geodetic{0.0, 180.0, 0.0}, Geodetic{51.6, -30.0, 400e3},
          Geodetic{0.0, 75.0, 36e6}, Geodetic{31.5, 35.5, -430.0}, kEye}) {
        Difference difference;
        difference.add(clockwork.state(instant, eye), compute_sky_state(instant, eye));
        EXPECT_LE(difference.sun_moon_arcsec, 1e-4);
        EXPECT_LE(difference.planets_arcsec, 1e-4);
        EXPECT_LE(difference.stars_arcsec, 1e-4);
    }
    EXPECT_EQ(clockwork.evaluations(), 2U);
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
        tests::raise(largest_arcsec, moved_arcsec);
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

/// Nanoseconds a call, median of rounds.
template <typename Call>
double median_ns(int rounds, int calls, const Call& call) {
    using Clock = std::chrono::steady_clock;
    std::vector<double> ns;
    for (int round = 0; round < rounds; ++round) {
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < calls; ++i)
            call();
        ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count() / calls);
    }
    std::nth_element(ns.begin(), ns.begin() + rounds / 2, ns.end());
    return ns[static_cast<std::size_t>(rounds) / 2];
}

TEST(SkyClockwork, CostsUnderAMillisecondAJump) {
    double sum = 0.0;
    const UtcClockTime time = clock_at("2026-06-21T12:00:00Z");
    for (const Model model : {Model::kAlmanac, Model::kErfa, Model::kSeries}) {
        SkyClockwork clockwork(model);
        Instant instant = make_instant(time);
        Geodetic eye = kEye;
        const double frame_ns = median_ns(41, 500, [&] {
            eye.longitude_deg += 1e-5;
            instant.ut1.fraction += 1e-9;
            sum += clockwork.state(instant, eye).sun.direction_enu.z;
        });
        UtcClockTime jumping = clock_at("1950-01-01T00:00:00Z");
        const double jump_ns = median_ns(41, 5, [&] {
            jumping.advance(1e6);
            sum += clockwork.state(make_instant(jumping), eye).sun.direction_enu.z;
        });
        const double computed_ns =
            median_ns(41, 5, [&] { sum += compute_sky_state(instant, eye, model).sun.direction_enu.z; });
        const std::string name(kModelNames[static_cast<std::size_t>(model)]);
        std::printf("%s: frame %.0f ns, jump %.0f ns, compute_sky_state %.0f ns\n", name.c_str(), frame_ns,
                    jump_ns, computed_ns);
        RecordProperty(name + "_frame_ns", static_cast<int>(frame_ns));
        RecordProperty(name + "_jump_ns", static_cast<int>(jump_ns));
        // Wide, since the machine may be busy and the build may carry sanitizers; frame_cost_test.cpp has the
        // frame's own bound.
        EXPECT_LE(jump_ns, 10e6);
        if (model == Model::kSeries) {
            EXPECT_LE(frame_ns, 0.1 * computed_ns);
        }
    }
    EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace skyig::server::ephemeris
