// What falls: how it dims the view and how fast it comes down.
#include "render/precipitation/extinction.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "render/precipitation/fall.h"

namespace skyig::render::precipitation {
namespace {

using Kind = Precipitation::Kind;

// Twice the cross section of all drops, summed drop size by drop size.
double summed_extinction_per_m(double n0_per_m3_mm, double slope_per_mm) {
    constexpr double kStep_mm = 1e-3;
    double sum_mm2 = 0.0;
    for (double d = 0.5 * kStep_mm; d < 20.0; d += kStep_mm)
        sum_mm2 += n0_per_m3_mm * std::exp(-slope_per_mm * d) * 0.5 * M_PI * d * d * kStep_mm;
    return sum_mm2 * 1e-6;
}

// Published tables: of Marshall and Palmer's drops, and what links measure in rain and snow, in dB/km.
TEST(Extinction, OfRainAndSnowIsThatOfTheTables) {
    struct Row {
        double rate_mm_h, extinction_per_m;
    };
    double worst = 0.0;
    for (const Row& row : {Row{1.0, 3.65e-4}, Row{5.0, 1.00e-3}, Row{10.0, 1.56e-3}, Row{25.0, 2.77e-3},
                           Row{50.0, 4.29e-3}, Row{100.0, 6.64e-3}})
        worst = std::max(worst, std::abs(rain_extinction_per_m(row.rate_mm_h) / row.extinction_per_m - 1.0));
    for (const double rate : {0.5, 1.0, 2.0, 4.0}) {
        const double dry = 5.5 * std::pow(rate, 1.38) / 4342.94;
        const double wet = 3.8 * std::pow(rate, 0.72) / 4342.94;
        worst = std::max(worst, std::abs(snow_extinction_per_m(rate, 0.0) / dry - 1.0));
        worst = std::max(worst, std::abs(snow_extinction_per_m(rate, 1.0) / wet - 1.0));
    }
    std::printf("worst against the tables: %.2f %%\n", 100.0 * worst);
    EXPECT_LT(worst, 0.01);
    // Visibilities at a contrast of 2 %, of dry snow.
    EXPECT_NEAR(3.912 / snow_extinction_per_m(1.0, 0.0), 3100.0, 100.0);
    EXPECT_NEAR(3.912 / snow_extinction_per_m(4.0, 0.0), 450.0, 25.0);
}

TEST(Extinction, IsTheCrossSectionOfTheDropsOfTheirDistribution) {
    for (const double rate : {0.2, 2.0, 30.0}) {
        EXPECT_NEAR(rain_extinction_per_m(rate), summed_extinction_per_m(8000.0, rain_slope_per_mm(rate)),
                    1e-3 * rain_extinction_per_m(rate));
        EXPECT_NEAR(drizzle_extinction_per_m(rate),
                    summed_extinction_per_m(30000.0, drizzle_slope_per_mm(rate)),
                    1e-3 * drizzle_extinction_per_m(rate));
    }
}

// What passes through a level plane in an hour is the rate, whatever the drops: a check of the stones' sizes,
// and, roughly, of the fall speeds against the drops that were measured with them.
TEST(Extinction, AndFallBringDownTheRate) {
    const double stones_per_m3 =
        hail_extinction_per_m(20.0) / (0.5 * M_PI * kHail_mm * kHail_mm * 1e-6);  // Q = 2
    const double ice_m3 = M_PI / 6.0 * std::pow(1e-3 * kHail_mm, 3);
    EXPECT_NEAR(stones_per_m3 * ice_m3 * 0.9 * hail_fall_speed_m_s(kHail_mm) * 3.6e6, 20.0, 1e-6);
    for (const double rate : {2.0, 10.0, 40.0}) {
        constexpr double kStep_mm = 1e-3;
        double water_mm_h = 0.0;
        for (double d = 0.11; d < 12.0; d += kStep_mm) {
            water_mm_h += 8000.0 * std::exp(-rain_slope_per_mm(rate) * d) * M_PI / 6.0 * d * d * d * 1e-9 *
                          drop_fall_speed_m_s(d) * kStep_mm * 3.6e6;
        }
        std::printf("%.0f mm/h asked, %.1f fall\n", rate, water_mm_h);
        EXPECT_NEAR(water_mm_h / rate, 1.0, 0.2);
    }
}

TEST(Extinction, OfNothingIsNothingAndSleetLiesBetween) {
    for (const Kind kind : {Kind::kRain, Kind::kDrizzle, Kind::kSnow, Kind::kSleet, Kind::kHail}) {
        EXPECT_EQ(extinction_per_m(kind, 0.0, 0.0), 0.0);
        EXPECT_EQ(extinction_per_m(kind, -1.0, 0.0), 0.0);
        EXPECT_GT(extinction_per_m(kind, 1e-9, 0.0), 0.0);
        EXPECT_LT(extinction_per_m(kind, 1e-9, 0.0), 1e-6);
        EXPECT_GT(extinction_per_m(kind, 5.0, -5.0), extinction_per_m(kind, 1.0, -5.0));
    }
    const double sleet = extinction_per_m(Kind::kSleet, 4.0, 1.0);
    EXPECT_GT(sleet, 0.5 * rain_extinction_per_m(4.0));
    EXPECT_LT(sleet, rain_extinction_per_m(4.0) + snow_extinction_per_m(4.0, 1.0));
    // Frost makes snow dry, and nothing jumps on the way.
    double before = extinction_per_m(Kind::kSnow, 3.0, -4.0);
    EXPECT_EQ(before, snow_extinction_per_m(3.0, 0.0));
    for (double t = -4.0; t < 3.0; t += 0.01) {
        const double now = extinction_per_m(Kind::kSnow, 3.0, t);
        EXPECT_NEAR(now, before, 0.01 * before);
        before = now;
    }
    EXPECT_EQ(before, snow_extinction_per_m(3.0, 1.0));
}

TEST(Fall, IsThatOfTheMeasuredDropsAndFasterAloft) {
    EXPECT_NEAR(drop_fall_speed_m_s(1.0), 4.0, 0.05);
    EXPECT_NEAR(drop_fall_speed_m_s(2.0), 6.55, 0.05);
    EXPECT_NEAR(drop_fall_speed_m_s(3.0), 7.9, 0.1);
    EXPECT_NEAR(drop_fall_speed_m_s(5.0), 9.1, 0.1);
    EXPECT_EQ(drop_fall_speed_m_s(0.05), 0.0);
    EXPECT_NEAR(median_drop_mm(rain_slope_per_mm(10.0)), 1.45, 0.01);
    // Density of the standard atmosphere at 5 km: 0.7361 kg/m3 of 1.2250.
    EXPECT_NEAR(aloft_factor(5000.0), std::pow(1.2250 / 0.7361, 0.4), 1e-3);
    EXPECT_EQ(aloft_factor(0.0), 1.0);
    EXPECT_EQ(aloft_factor(1e6), aloft_factor(20e3));
}

TEST(Fall, ComesFromAheadInFlight) {
    Weather weather;
    weather.wind_m_s = {3.0, 0.0, 0.0};
    weather.eye_velocity_m_s = {0.0, 70.0, 2.0};
    const glm::dvec3 wind = relative_wind_m_s(weather, 6.0);
    EXPECT_EQ(wind, (glm::dvec3{3.0, -70.0, -8.0}));
}

}  // namespace
}  // namespace skyig::render::precipitation
