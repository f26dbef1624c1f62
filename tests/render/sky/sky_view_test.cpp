#include "render/sky/sky_view.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <limits>
#include <utility>

#include "render/sky/kernels.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

const AirTables& clear_air() {
    static const AirTables tables(air_model({}));
    return tables;
}

float radians(double degrees) {
    return static_cast<float>(degrees * kDeg);
}

constexpr double kHeights[] = {-430.0, 0.0,     2.0,       1500.0,  12.0e3, 20.0e3,
                               99.0e3, 120.0e3, 120.001e3, 400.0e3, 3.6e7};
constexpr double kSources[] = {90.0, 89.9999, 45.0, 1.0, 0.0, -0.2, -1.0, -6.0, -12.0, -18.0, -40.0, -90.0};

TEST(SkyView, IsFiniteAndNeverNegativeInHardCases) {
    SkyView view(SkyViewSize{24, 12, 17, 24});
    int directions = 0;
    for (const double height_m : kHeights) {
        for (const double source : kSources) {
            view.begin(clear_air(), height_m, source * kDeg);
            view.build_all();
            ASSERT_TRUE(view.complete());
            const double horizon = view.horizon_elevation_rad();
            for (const double elevation : {90.0, 89.99, 45.0, source, 1e-4, 0.0, horizon / kDeg + 1e-5,
                                           horizon / kDeg, horizon / kDeg - 1e-5, -30.0, -90.0}) {
                for (const double azimuth : {0.0, 1e-6, 90.0, 180.0, -180.0, 360.0, 1e6}) {
                    const float e = radians(elevation);
                    const float a = radians(azimuth);
                    for (const glm::vec3& xyz :
                         {view.xyz(e, a), view.xyz_above(e, a), view.xyz_below(e, a)}) {
                        for (int k = 0; k < 3; ++k) {
                            ASSERT_TRUE(std::isfinite(xyz[k]) && xyz[k] >= 0.0F)
                                << height_m << ' ' << source << ' ' << elevation << ' ' << azimuth;
                        }
                    }
                    ++directions;
                }
            }
        }
    }
    std::printf("%d directions\n", directions);
}

TEST(SkyView, HostilesNumbersDoNoHarm) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    SkyView view(SkyViewSize{8, 8, 9, 8});
    for (const double height_m : {nan, inf, -inf, 1e300}) {
        for (const double source : {nan, inf, -inf, 1e300, 0.3}) {
            view.begin(clear_air(), height_m, source);
            view.build_all();
            for (const double angle : {0.5, nan, inf, -inf, 1e300}) {
                const auto value = static_cast<float>(std::isfinite(angle) ? std::min(angle, 1e30) : angle);
                const glm::vec3 xyz = view.xyz(value, value);
                EXPECT_TRUE(std::isfinite(xyz.x) && std::isfinite(xyz.y) && std::isfinite(xyz.z));
            }
        }
    }
}

TEST(SkyView, SlicesGiveTheSameBits) {
    SkyView whole;
    SkyView sliced;
    whole.begin(clear_air(), 3000.0, 0.2);
    whole.build_all();
    sliced.begin(clear_air(), 3000.0, 0.2);
    int calls = 1;
    for (; !sliced.build_rows(7); ++calls)
        EXPECT_FALSE(sliced.complete());
    EXPECT_EQ(calls, (whole.size().sky_rows + whole.size().ground_rows + 6) / 7);
    EXPECT_TRUE(sliced.build_rows(1));
    for (const double elevation : steps(-1.57, 1.57, 0.0173)) {
        for (const double azimuth : steps(0.0, 6.3, 0.37)) {
            ASSERT_EQ(whole.xyz(f32(elevation), f32(azimuth)), sliced.xyz(f32(elevation), f32(azimuth)));
        }
    }
}

TEST(SkyView, CanBeBuiltAgainForOtherAir) {
    Air mist;
    mist.visibility_m = 3000.0;
    const AirTables misty(air_model(mist));
    SkyView reused;
    SkyView fresh;
    reused.begin(clear_air(), 3.6e7, -1.0);
    reused.build_rows(13);
    for (SkyView* view : {&reused, &fresh}) {
        view->begin(misty, 100.0, 0.7);
        view->build_all();
    }
    for (const double elevation : steps(-1.57, 1.57, 0.0173)) {
        ASSERT_EQ(reused.xyz(f32(elevation), 1.0F), fresh.xyz(f32(elevation), 1.0F));
    }
}

TEST(SkyView, IsSymmetricAboutTheSource) {
    SkyView view;
    view.begin(clear_air(), 100.0, 0.3);
    view.build_all();
    for (const double elevation : steps(-1.5, 1.57, 0.11)) {
        for (const double azimuth : steps(0.01, 3.1, 0.173)) {
            const float luminance = view.xyz(f32(elevation), f32(azimuth)).y;
            EXPECT_FLOAT_EQ(view.xyz(f32(elevation), f32(-azimuth)).y, luminance);
            EXPECT_NEAR(view.xyz(f32(elevation), f32(azimuth + 6.283185307179586)).y / luminance, 1.0F,
                        1e-4F);
        }
    }
}

TEST(SkyView, DoesNotDependOnAzimuthUnderAZenithSun) {
    SkyView view;
    view.begin(clear_air(), 2.0, 90.0 * kDeg);
    view.build_all();
    double largest = 0.0;
    for (const double elevation : steps(-89.0, 90.0, 1.7)) {
        const auto ahead = static_cast<double>(view.xyz(radians(elevation), 0.0F).y);
        for (const double azimuth : steps(10.0, 180.0, 17.0)) {
            largest =
                std::max(largest, std::abs(view.xyz(radians(elevation), radians(azimuth)).y / ahead - 1.0));
        }
    }
    std::printf("largest relative difference %.1e\n", largest);
    EXPECT_LT(largest, 1e-3);
}

TEST(SkyView, SplitsAtTheGeometricHorizon) {
    SkyView view;
    for (const double height_m : {2.0, 3000.0, 12.0e3, 400.0e3}) {
        view.begin(clear_air(), height_m, 0.5);
        view.build_all();
        const double horizon = view.horizon_elevation_rad();
        EXPECT_NEAR(std::cos(horizon), 6371.0e3 / (6371.0e3 + height_m), 1e-12);
        EXPECT_EQ(view.sky_row_elevation_rad(0), horizon);
        EXPECT_EQ(view.ground_row_elevation_rad(0), horizon);
        EXPECT_NEAR(view.ground_row_elevation_rad(view.size().ground_rows - 1), -90.0 * kDeg, 1e-9);
        const auto edge = static_cast<float>(horizon);
        EXPECT_EQ(view.xyz_above(edge - 0.1F, 1.0F).y, view.xyz_above(edge, 1.0F).y);
        EXPECT_EQ(view.xyz_below(edge + 0.1F, 1.0F).y, view.xyz_below(edge, 1.0F).y);
        EXPECT_EQ(view.xyz(edge + 0.1F, 1.0F).y, view.xyz_above(edge + 0.1F, 1.0F).y);
        EXPECT_EQ(view.xyz(edge - 0.1F, 1.0F).y, view.xyz_below(edge - 0.1F, 1.0F).y);
    }
}

TEST(SkyView, TheHorizonIsNoLineInThickHaze) {
    render::Air haze;
    haze.visibility_m = 3000.0;
    const AirTables tables(air_model(haze));
    SkyView view;
    double largest = 0.0;
    for (const double height_m : {30.0, 200.0, 600.0, 1500.0}) {
        view.begin(tables, height_m, 45.0 * kDeg);
        view.build_all();
        const auto horizon = static_cast<float>(view.horizon_elevation_rad());
        for (const float azimuth : {0.0F, 1.5F, 3.1F}) {
            const float above = view.xyz_above(horizon + 1e-4F, azimuth).y;
            const float below = view.xyz_below(horizon - 1e-4F, azimuth).y;
            largest = std::max(largest, static_cast<double>(std::abs(above / below - 1.0F)));
        }
    }
    std::printf("sky above the horizon against ground below it, 3 km: %.2f %%\n", 100.0 * largest);
    EXPECT_LT(largest, 0.004);
}

TEST(SkyView, TheLimbKeepsItsColourWhereTheEarthsShadowEndsIt) {
    SkyView view;
    view.begin(clear_air(), 3.6e7, -66.57 * kDeg);
    view.build_all();
    float least = 1.0F;
    int lit = 0;
    for (const double azimuth : steps(0.0, 3.14, 0.01)) {
        for (const double above : steps(-0.003, 0.003, 5e-5)) {
            const glm::vec3 xyz = view.xyz(f32(view.horizon_elevation_rad() + above), f32(azimuth));
            if (!(xyz.z > 1e-3F)) continue;
            ++lit;
            // Sunlight scattered by molecules alone ends at x = 0.24; ozone takes it to some 0.15.
            least = std::min(least, xyz.x / (xyz.x + xyz.y + xyz.z));
        }
    }
    std::printf("limb from 36,000 km: x of its chromaticity at least %.3f, %d places\n",
                static_cast<double>(least), lit);
    EXPECT_GT(lit, 1000);
    EXPECT_GT(least, 0.12F);
}

TEST(SkyView, SpaceIsBlack) {
    SkyView view;
    for (const double height_m : {120.001e3, 400.0e3, 3.6e7}) {
        view.begin(clear_air(), height_m, 0.3);
        view.build_all();
        const double limb = -std::acos((6371.0e3 + 120.0e3) / (6371.0e3 + height_m));
        for (const double elevation : {limb + 1e-5, 0.5 * limb, 0.0, 0.3, 90.0 * kDeg}) {
            EXPECT_EQ(view.xyz(static_cast<float>(elevation), 0.5F), glm::vec3(0.0F))
                << height_m << ' ' << elevation;
        }
        EXPECT_GT(view.xyz(static_cast<float>(view.horizon_elevation_rad() + 1e-4), 0.5F).y, 0.0F);
    }
}

TEST(SkyView, ChangesLittleWhenTheSourceOrTheEyeMovesLittle) {
    SkyView here;
    SkyView there;
    double largest = 0.0;
    for (const double source : {89.99, 30.0, 0.2, -0.01, -4.0, -9.0, -17.0}) {
        here.begin(clear_air(), 5000.0, source * kDeg);
        there.begin(clear_air(), 5001.0, (source - 0.005) * kDeg);
        here.build_all();
        there.build_all();
        for (const double above : powers(0.001, 1.5, 1.7)) {
            const auto a = static_cast<double>(here.xyz(f32(here.horizon_elevation_rad() + above), 0.7F).y);
            const auto b = static_cast<double>(there.xyz(f32(there.horizon_elevation_rad() + above), 0.7F).y);
            largest = std::max(largest, std::abs(a - b) / (a + 1e-4));
        }
    }
    std::printf("largest relative change for 0.005 deg and 1 m: %.4f\n", largest);
    EXPECT_LT(largest, 0.02);
}

TEST(SkyView, DarkensStepByStepThroughTwilight) {
    SkyView view;
    float previous = std::numeric_limits<float>::infinity();
    for (const double source : steps(5.0, -20.0, -0.5)) {
        view.begin(clear_air(), 2.0, source * kDeg);
        view.build_all();
        const float zenith = view.xyz(radians(90.0), 0.0F).y;
        EXPECT_LT(zenith, previous);
        previous = zenith;
    }
    EXPECT_LT(previous, 1e-5F);
}

TEST(SkyView, CostsAreKnown) {
    SkyView view;
    double build_ms = 1e9;
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        view.begin(clear_air(), 2.0, 0.1 + 0.01 * i);
        view.build_all();
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        build_ms = std::min(build_ms, spent.count());
    }
    constexpr int kCount = 200000;
    float sum = 0.0F;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kCount; ++i) {
        sum += view.xyz(static_cast<float>(i % 1571) * 1e-3F, static_cast<float>(i % 3141) * 1e-3F).y;
    }
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
    std::printf("%s: build %.1f ms, look-up %.0f ns\n", kernels().name, build_ms, spent.count() / kCount);
    EXPECT_GT(sum, 0.0F);
    EXPECT_LT(build_ms, 5000.0);
}

}  // namespace
}  // namespace skyig::render::sky
