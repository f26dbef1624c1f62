#include "server/ephemeris/theory/theory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/theory/theory_cases.h"
#include "tests/support/allocation_count.h"

namespace {

using namespace skyig::server::ephemeris;
using namespace skyig::tests;
using theory::PositionVelocity;

constexpr JulianDate kJ2000{.day = 2451545.0, .fraction = 0.0};

bool is_finite(const PositionVelocity& body) {
    for (glm::length_t i = 0; i < 3; ++i) {
        if (!std::isfinite(body.position_km[i]) || !std::isfinite(body.velocity_km_s[i])) return false;
    }
    return true;
}

bool same_bits(const PositionVelocity& a, const PositionVelocity& b) {
    return a.position_km == b.position_km && a.velocity_km_s == b.velocity_km_s;
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double bound) {
    EXPECT_NEAR(actual.x, expected.x, bound);
    EXPECT_NEAR(actual.y, expected.y, bound);
    EXPECT_NEAR(actual.z, expected.z, bound);
}

TEST(Theory, MoonOfElpmpp02GivesItsPublishedCheckValues) {
    expect_near(theory::moon_elpmpp02(kJ2000).position_km, {-291608.459, -266716.726, -76102.441}, 6e-4);
    expect_near(theory::moon_elpmpp02({.day = 2460409.0, .fraction = 0.2625}).position_km,
                {340149.760, 106728.543, 48627.883}, 6e-4);
}

TEST(Theory, MoonOfElpmpp02StandsWhereDe441HasIt) {
    struct Truth {
        JulianDate tt;
        glm::dvec3 position_km;
    };
    for (const Truth& truth : {Truth{kJ2000, {-291608.384, -266716.834, -76102.487}},
                               Truth{{2460409.0, 0.2625}, {340149.683, 106728.475, 48628.210}}}) {
        const glm::dvec3 moon_km = theory::moon_elpmpp02(truth.tt).position_km;
        const double error_arcsec = angle_arcsec(moon_km, truth.position_km);
        const double range_error_km = std::abs(glm::length(moon_km) - glm::length(truth.position_km));
        std::printf("JD %.4f: %.3f arcsec, %.3f km\n", truth.tt.day + truth.tt.fraction, error_arcsec,
                    range_error_km);
        EXPECT_LE(error_arcsec, 0.41);
        EXPECT_LE(range_error_km, 0.35);
    }
}

TEST(Theory, PlanetsOfVsop87GiveTheirPublishedCheckValues) {
    const auto au = [](Body planet) {
        return theory::planet_vsop87(planet, kJ2000).position_km / kKilometresPerAu;
    };
    expect_near(au(Body::kVenus), {-0.71830225, -0.04627410, 0.02464056}, 6e-9);
    expect_near(au(Body::kMars), {1.39071600, 0.00140166, -0.03695998}, 6e-9);
    expect_near(au(Body::kJupiter), {4.00117472, 2.73658138, 1.07551542}, 6e-9);
}

TEST(Theory, EarthStandsWhereVsop87HasItAtJ2000) {
    const glm::dvec3 vsop87_au{-0.17713500, 0.88742853, 0.38474287};
    const glm::dvec3 epv00_km = theory::earth_epv00(kJ2000).heliocentric.position_km;
    const double error_arcsec = angle_arcsec(epv00_km, vsop87_au);
    std::printf("epv00 against VSOP87 at J2000: %.4f arcsec\n", error_arcsec);
    EXPECT_LE(error_arcsec, 0.04);
    EXPECT_NEAR(glm::length(epv00_km) / kKilometresPerAu, glm::length(vsop87_au), 1e-7);
}

TEST(Theory, BarycentreIsWithinTwoSolarRadiiOfTheSun) {
    double greatest_km = 0.0;
    for (const JulianDate& tt : dates_1900_2100(100)) {
        const theory::EarthMotion earth = theory::earth_epv00(tt);
        const double distance_km =
            glm::length(earth.heliocentric.position_km - earth.barycentric.position_km);
        skyig::tests::raise(greatest_km, distance_km);
        const theory::EarthMotion almanac = theory::earth_almanac(tt);
        EXPECT_TRUE(same_bits(almanac.heliocentric, almanac.barycentric));
    }
    std::printf("Sun to barycentre: at most %.0f km\n", greatest_km);
    EXPECT_GT(greatest_km, 695700.0);
    EXPECT_LT(greatest_km, 2.2 * 695700.0);
}

TEST(Theory, SunAndMoonAreNoPlanets) {
    for (const Body body : {Body::kSun, Body::kMoon}) {
        EXPECT_TRUE(same_bits(theory::planet_vsop87(body, kJ2000), {}));
        EXPECT_TRUE(same_bits(theory::planet_plan94(body, kJ2000), {}));
        EXPECT_TRUE(same_bits(theory::planet_elements(body, kJ2000), {}));
    }
}

TEST(Theory, EveryFiniteDateGivesAFinitePlace) {
    constexpr double kLargest = std::numeric_limits<double>::max();
    const std::vector<JulianDate> dates{{.day = 0.0, .fraction = 0.0},
                                        {.day = 2451545.0 + 365250000.0, .fraction = 0.25},
                                        {.day = 2451545.0 - 365250000.0, .fraction = 0.25},
                                        {.day = kLargest, .fraction = 0.0},
                                        {.day = -kLargest, .fraction = 0.0},
                                        {.day = 2451545.0, .fraction = kLargest},
                                        {.day = 5e-324, .fraction = -5e-324}};
    for (const TheoryCase& theory : all_theories()) {
        for (const JulianDate& tt : dates) {
            EXPECT_TRUE(is_finite(theory.at(tt))) << theory.name << " at " << tt.day << " + " << tt.fraction;
        }
    }
}

TEST(Theory, BodiesStayNearTheirOrbitsAsFarAsTheTheoriesAreFollowed) {
    // From -3000 to 7000 and beyond: distances between half the least and twice the greatest of our time.
    for (const TheoryCase& theory : all_theories()) {
        double least_km = std::numeric_limits<double>::max();
        double greatest_km = 0.0;
        for (const JulianDate& tt : dates_1900_2100(100)) {
            least_km = std::min(least_km, glm::length(theory.at(tt).position_km));
            skyig::tests::raise(greatest_km, glm::length(theory.at(tt).position_km));
        }
        for (int year = -4000; year <= 8000; year += 37) {
            const JulianDate tt{.day = 2451545.0 + std::floor(365.25 * (year - 2000)), .fraction = 0.0};
            const double distance_km = glm::length(theory.at(tt).position_km);
            EXPECT_GT(distance_km, 0.5 * least_km) << theory.name << " in " << year;
            EXPECT_LT(distance_km, 2.0 * greatest_km) << theory.name << " in " << year;
        }
    }
}

TEST(Theory, NotANumberGivesNotANumber) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const TheoryCase& theory : all_theories()) {
        for (const JulianDate& tt : {JulianDate{kNan, 0.0}, JulianDate{2451545.0, kNan}}) {
            const glm::dvec3 position_km = theory.at(tt).position_km;
            EXPECT_TRUE(std::isnan(position_km.x) && std::isnan(position_km.y) && std::isnan(position_km.z))
                << theory.name;
        }
    }
}

TEST(Theory, HowADateIsSplitInTwoDoesNotMatter) {
    double greatest_s = 0.0;
    for (const TheoryCase& theory : all_theories()) {
        for (const JulianDate& tt : dates_1900_2100(50)) {
            const PositionVelocity at = theory.at(tt);
            constexpr double kMjdZero_jd = 2400000.5;
            const PositionVelocity split =
                theory.at({.day = kMjdZero_jd, .fraction = (tt.day - kMjdZero_jd) + tt.fraction});
            const double apart_s =
                glm::length(at.position_km - split.position_km) / glm::length(at.velocity_km_s);
            EXPECT_LE(apart_s, 1e-5) << theory.name;
            skyig::tests::raise(greatest_s, apart_s);
        }
    }
    std::printf("two ways to write a date: places at most %.2g s apart\n", greatest_s);
}

TEST(Theory, ThreadsGetTheNumbersOfASingleThread) {
    const std::vector<TheoryCase> theories = all_theories();
    const std::vector<JulianDate> dates = dates_1900_2100(20);
    const auto evaluate = [&] {
        std::vector<PositionVelocity> out;
        for (const TheoryCase& theory : theories) {
            for (const JulianDate& tt : dates)
                out.push_back(theory.at(tt));
        }
        return out;
    };
    const std::vector<PositionVelocity> expected = evaluate();
    std::vector<std::vector<PositionVelocity>> results(4);
    std::vector<std::thread> threads;
    for (auto& result : results)
        threads.emplace_back([&result, &evaluate] { result = evaluate(); });
    for (std::thread& thread : threads)
        thread.join();
    for (const auto& result : results) {
        ASSERT_EQ(result.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_TRUE(same_bits(result[i], expected[i])) << theories[i / dates.size()].name;
    }
}

TEST(Theory, AsksForNoMemory) {
    // Prints what each costs on the way; a busy machine is no reason to fail.
    for (const TheoryCase& theory : all_theories()) {
        constexpr int kCalls = 300;
        glm::dvec3 sum_km{0.0};
        const std::uint64_t before = allocation_count_of_this_thread();
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < kCalls; ++i)
            sum_km += theory.at({.day = 2451545.0 + i, .fraction = 0.3}).position_km;
        const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
        EXPECT_EQ(allocation_count_of_this_thread(), before) << theory.name;
        EXPECT_TRUE(std::isfinite(sum_km.x + sum_km.y + sum_km.z)) << theory.name;
        std::printf("%-28s %8.0f ns\n", theory.name.c_str(), spent.count() / kCalls);
    }
}

}  // namespace
