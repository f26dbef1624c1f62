// What the coarse table and the few steps of a view cost in accuracy: look-up against a table three times as
// dense each way (interpolation), and against one with 400 steps at the same nodes (march).
#include <gtest/gtest.h>

#include <cstdio>

#include "render/sky/sky_view.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

struct Pair {
    Errors interpolation;
    Errors march;
};

void compare(const SkyView& usual, const SkyView& dense, const SkyView& exact, Pair& sky, Pair& ground) {
    const double horizon = usual.horizon_elevation_rad();
    double brightest = 0.0;
    for (int i = 0; i < exact.size().sky_rows; ++i) {
        const auto e = static_cast<float>(exact.sky_row_elevation_rad(i));
        for (int j = 0; j < 20; ++j)
            brightest =
                std::max(brightest, static_cast<double>(exact.xyz_above(e, 0.16F * static_cast<float>(j)).y));
    }
    // Darker than the night sky, or than a ten-thousandth of the brightest part, is not seen.
    const double floor = 1.7e-4 + 1e-4 * brightest;
    for (int i = 0; i < 120; ++i) {
        const double part = std::pow((i + 0.5) / 120.0, 3.0);
        for (int j = 0; j < 30; ++j) {
            const auto azimuth = static_cast<float>((j + 0.37) / 30.0 * 180.0 * kDeg);
            const auto up = static_cast<float>(horizon + part * (90.0 * kDeg - horizon));
            const auto down = static_cast<float>(horizon - part * (90.0 * kDeg + horizon));
            const auto add = [&](double a, double b, double c, Pair& errors) {
                errors.interpolation.add((a - b) / (b + floor));
                errors.march.add((a - c) / (c + floor));
            };
            add(usual.xyz_above(up, azimuth).y, dense.xyz_above(up, azimuth).y,
                exact.xyz_above(up, azimuth).y, sky);
            add(usual.xyz_below(down, azimuth).y, dense.xyz_below(down, azimuth).y,
                exact.xyz_below(down, azimuth).y, ground);
        }
    }
}

class Interpolation : public testing::TestWithParam<double> {};

TEST_P(Interpolation, StaysBelowItsBounds) {
    const AirTables tables(air_model({}));
    const double height_m = GetParam();
    SkyView usual;
    SkyView dense(SkyViewSize{120, 60, 97, 48});
    SkyView exact(SkyViewSize{40, 20, 33, 400});
    for (const double source : {60.0, 10.0, 1.0, -3.0, -6.0, -9.0}) {
        for (SkyView* view : {&usual, &dense, &exact}) {
            view->begin(tables, height_m, source * kDeg);
            view->build_all();
        }
        Pair sky;
        Pair ground;
        compare(usual, dense, exact, sky, ground);
        for (const auto& [errors, name] : {std::pair{&sky, "sky"}, std::pair{&ground, "ground"}}) {
            std::printf(
                "eye %6.0f m, sun %3.0f deg, %-6s: interpolation p50 %.3f %% p99 %.2f %%, march p50 %.3f %% "
                "p99 %.2f %%\n",
                height_m, source, name, 100.0 * errors->interpolation.quantile(0.5),
                100.0 * errors->interpolation.quantile(0.99), 100.0 * errors->march.quantile(0.5),
                100.0 * errors->march.quantile(0.99));
        }
        EXPECT_LT(sky.interpolation.quantile(0.99), source > -5.0 ? 0.01 : 0.03);
        EXPECT_LT(ground.interpolation.quantile(0.99), 0.03);
        EXPECT_LT(sky.march.quantile(0.5), 0.015);
        // Worst where sunlight just grazes the ground on its way to the air near the horizon.
        EXPECT_LT(sky.march.quantile(0.99), source > -2.0 ? 0.02 : 0.12);
    }
}

INSTANTIATE_TEST_SUITE_P(Heights, Interpolation, testing::Values(2.0, 1500.0, 12.0e3));

}  // namespace
}  // namespace skyig::render::sky
