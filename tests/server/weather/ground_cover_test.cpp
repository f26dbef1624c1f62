// Water and snow on the land against the closed forms of their rates.
#include "server/weather/ground_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace skyig::server::weather {
namespace {

constexpr double kHour_s = 3600.0;

GroundCover after(const Reaching& reaching, double seconds, int steps, GroundCover cover = {}) {
    for (int i = 0; i < steps; ++i)
        cover.advance(reaching, seconds / steps);
    return cover;
}

TEST(GroundCover, TheFilmIsWhatRainBringsLessWhatDrainsHoweverLongTheSteps) {
    const Reaching drizzle{0.4, 0.0, 10.0};
    // 0.4 mm/h for half an hour of draining: 0.2 mm in the end.
    const double wanted = 0.2 * (1.0 - std::exp(-kHour_s / GroundCover::kDrains_s));
    const GroundCover coarse = after(drizzle, kHour_s, 1);
    const GroundCover fine = after(drizzle, kHour_s, 108'000);
    std::printf("  film after an hour of 0.4 mm/h: %.6f mm, closed form %.6f\n", fine.water_mm(), wanted);
    EXPECT_NEAR(coarse.water_mm(), wanted, 1e-12);
    EXPECT_NEAR(fine.water_mm(), wanted, 1e-9);
    EXPECT_NEAR(fine.wet(), wanted / 0.5, 1e-9);
    GroundCover settled;
    settled.settle(drizzle);
    EXPECT_NEAR(settled.water_mm(), 0.2, 1e-12);
    // Hard rain: no more than the road holds, in minutes.
    const GroundCover flooded = after({15.0, 0.0, 10.0}, 300.0, 30);
    EXPECT_DOUBLE_EQ(flooded.water_mm(), GroundCover::kHolds_mm);
    EXPECT_NEAR(after({0.0, 0.0, 10.0}, kHour_s, 7, flooded).wet(), std::exp(-2.0), 1e-12);
}

TEST(GroundCover, SnowWhitensByItsDepthAndMeltsByTheDegree) {
    const Reaching snow{0.0, 2.0, -3.0};
    const double density = 67.92 + 51.25 * std::exp(-3.0 / 2.59);
    double before = 0.0;
    for (const double minutes : {5.0, 15.0, 30.0, 60.0, 120.0}) {
        const GroundCover lies = after(snow, 60.0 * minutes, 100);
        const double depth_m = 2.0 * minutes / 60.0 / density;
        std::printf("  %3.0f min of 2 mm/h: %.1f mm deep, covers %.2f\n", minutes, 1e3 * lies.snow_depth_m(),
                    lies.snow());
        EXPECT_NEAR(lies.snow_depth_m(), depth_m, 1e-9);
        EXPECT_NEAR(lies.snow(), std::tanh(depth_m / 0.025), 1e-9);
        EXPECT_GT(lies.snow(), before);
        before = lies.snow();
    }
    EXPECT_GT(before, 0.9) << "two hours whiten the land";
    const GroundCover lies = after(snow, 2.0 * kHour_s, 100);
    const GroundCover thawed = after({0.0, 0.0, 4.0}, 3.0 * kHour_s, 100, lies);
    EXPECT_NEAR(thawed.snow_mm(), 4.0 - 12.0 / 24.0 * 3.0, 1e-9);
    EXPECT_NEAR(thawed.snow_depth_m() / lies.snow_depth_m(), thawed.snow_mm() / 4.0, 1e-9);
    EXPECT_GT(thawed.wet(), 0.3) << "by what melts";
    const GroundCover rained = after({10.0, 0.0, 4.0}, kHour_s, 100, lies);
    EXPECT_NEAR(lies.snow_mm() - rained.snow_mm(), 0.5 + 40.0 * 4.186 / 334.0, 1e-9);
    EXPECT_EQ(after({0.0, 0.0, 20.0}, 48.0 * kHour_s, 10, lies).snow(), 0.0);
    EXPECT_EQ(after({0.0, 0.0, -20.0}, 48.0 * kHour_s, 10, lies).snow_mm(), lies.snow_mm());
}

}  // namespace
}  // namespace skyig::server::weather
