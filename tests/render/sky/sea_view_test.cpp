// What the sea reflects through the air: finite and steady from everywhere, and where it must stand.
#include "render/sky/sea_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "render/sky/sea_sky.h"
#include "render/sky/sky_view.h"

namespace skyig::render::sky {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Ground breeze() {
    Ground ground;
    ground.kind = Ground::Kind::kSea;
    ground.wind_m_s = 5.0;
    ground.wind_from_rad = 0.7;
    return ground;
}

const AirTables& sea_air() {
    static const AirTables tables(air_model({}, breeze()));
    return tables;
}

SeaView view_of(double height_m, double source_deg) {
    SeaView view;
    view.begin(sea_air(), SeaSurface(slope_variance(breeze(), {})), height_m, source_deg * kDegree);
    while (!view.build_rows(5)) {
    }
    return view;
}

double luminance(const SeaView& view, double elevation_rad, double relative_deg) {
    return static_cast<double>(view.xyz(elevation_rad, -relative_deg * kDegree, 0.0).y);
}

TEST(SeaAir, GroundOfTheSeaIsDarkAndBlue) {
    const AirModel& model = sea_air().model();
    Spectrum below = model.ground_albedo;
    for (float& albedo : below)
        albedo -= model.ground_mirror_albedo;
    EXPECT_NEAR(luminous_albedo(model, model.ground_albedo), 0.056, 0.003);
    EXPECT_GT(below[1], 5.0F * below[10]);
    // OC4 (O'Reilly et al. 1998) reads the ratio of 443 to 555 nm as chlorophyll in mg/m3.
    const double ratio = std::log10(6.5e-3 / 1.7e-3);
    const double chlorophyll = std::pow(10.0, 0.366 - 3.067 * ratio + 1.93 * std::pow(ratio, 2) +
                                                  0.649 * std::pow(ratio, 3) - 1.532 * std::pow(ratio, 4));
    EXPECT_NEAR(chlorophyll, 0.15, 0.03);
}

TEST(SeaAir, SkyOfTheSurfaceIsThatOfTheView) {
    double worst_day = 0.0;
    double worst_twilight = 0.0;
    for (const double source_deg : {70.0, 33.0, 12.0, 2.0, -2.5, -7.0}) {
        SkyView sky;
        sky.begin(sea_air(), 0.01, source_deg * kDegree);
        sky.build_all();
        const SeaSky sea(sea_air().data(), std::sin(source_deg * kDegree));
        for (const double e_deg : {1.0, 7.0, 25.0, 60.0, 88.0}) {
            for (const double azimuth_deg : {0.0, 40.0, 100.0, 180.0}) {
                const auto exact =
                    static_cast<double>(sky.xyz_above(static_cast<float>(e_deg * kDegree),
                                                      static_cast<float>(azimuth_deg * kDegree))
                                            .y);
                const auto found =
                    static_cast<double>(sea.xyz(static_cast<float>(std::sin(e_deg * kDegree)),
                                                static_cast<float>(std::cos(azimuth_deg * kDegree)))
                                            .y);
                double& worst = source_deg > 0.0 ? worst_day : worst_twilight;
                worst = std::max(worst, std::abs(found / exact - 1.0));
            }
        }
    }
    std::printf("sky over the sea: largest error %.3f by day, %.3f in twilight\n", worst_day, worst_twilight);
    EXPECT_LT(worst_day, 0.08);
    EXPECT_LT(worst_twilight, 0.15);
}

TEST(SeaView, IsFiniteAndSteadyFromEverywhere) {
    double worst = 0.0;
    for (const double height_m : {-10.0, 0.0, 30.0, 12e3, 400e3}) {
        for (const double source_deg : {90.0, 30.0, 1.0, 0.0, -0.3, -9.0, -18.0}) {
            const SeaView view = view_of(height_m, source_deg);
            for (const double relative_deg : {0.0, 3.0, 90.0, 180.0}) {
                for (const double below_deg : {0.0, 0.001, 0.01, 0.3, 1.0, 4.0, 15.0, 60.0}) {
                    const double e = view.horizon_elevation_rad() - below_deg * kDegree;
                    const double here = luminance(view, e, relative_deg);
                    const double next = luminance(view, e - 0.001 * kDegree, relative_deg);
                    ASSERT_TRUE(std::isfinite(here) && here >= 0.0);
                    // From low down a thousandth of a degree is a good part of the way from the horizon.
                    if (below_deg >= 0.3) worst = std::max(worst, std::abs(next - here) / (here + 1e-3));
                }
            }
        }
    }
    std::printf("step of 0.001 deg: %.4f\n", worst);
    EXPECT_LT(worst, 0.01);
}

TEST(SeaView, MovesSteadilyWithSourceAndHeight) {
    double by_source = 0.0;
    double by_height = 0.0;
    for (const double source_deg : {40.0, 5.0, 0.2, -6.0}) {
        const SeaView here = view_of(300.0, source_deg);
        const SeaView later = view_of(300.0, source_deg + 0.001);
        const SeaView higher = view_of(301.0, source_deg);
        for (const double below_deg : {0.05, 1.0, 10.0, 40.0}) {
            for (const double relative_deg : {0.0, 20.0, 180.0}) {
                const auto at = [&](const SeaView& view) {
                    return luminance(view, view.horizon_elevation_rad() - below_deg * kDegree, relative_deg);
                };
                by_source = std::max(by_source, std::abs(at(later) / at(here) - 1.0));
                by_height = std::max(by_height, std::abs(at(higher) / at(here) - 1.0));
            }
        }
    }
    std::printf("0.001 deg of the source: %.5f, 1 m of height: %.5f\n", by_source, by_height);
    EXPECT_LT(by_source, 0.005);
    EXPECT_LT(by_height, 0.01);
}

TEST(SeaView, GlitterStandsBelowTheSourceAtTheMirrorsPlace) {
    for (const double height_m : {300.0, 12e3, 400e3}) {
        const SeaView view = view_of(height_m, 50.0);
        const double mirror_rad = mirror_elevation_rad(height_m, 50.0 * kDegree);
        const double at_mirror = luminance(view, mirror_rad, 0.0);
        EXPECT_GT(at_mirror, 20.0 * luminance(view, mirror_rad, 90.0)) << height_m;
        EXPECT_GT(at_mirror, 20.0 * luminance(view, mirror_rad, 180.0)) << height_m;
    }
    EXPECT_NEAR(mirror_elevation_rad(2.0, 50.0 * kDegree), -50.0 * kDegree, 1e-4);
    EXPECT_NEAR(mirror_elevation_rad(400e3, 90.0 * kDegree), -90.0 * kDegree, 1e-4);
}

TEST(SeaView, NothingIsBrighterThanTheSkyItMirrors) {
    SkyView sky;
    sky.begin(sea_air(), 0.01, -3.0 * kDegree);
    sky.build_all();
    float brightest = 0.0F;
    for (float e = 0.0F; e < 1.5F; e += 0.01F)
        for (float a = 0.0F; a < 3.14F; a += 0.1F)
            brightest = std::max(brightest, sky.xyz_above(e, a).y);
    const SeaView view = view_of(1.0, -3.0);
    for (double e = view.horizon_elevation_rad(); e > -1.5; e -= 0.01)
        for (double a = 0.0; a < 180.0; a += 10.0)
            EXPECT_LT(luminance(view, e, a), 1.05 * static_cast<double>(brightest));
}

TEST(SeaAir, SnowBrightensTheZenith) {
    Ground snowy;
    snowy.snow = 1.0;
    const AirTables bare(air_model({}));
    const AirTables snow(air_model({}, snowy));
    const auto zenith = [](const AirTables& tables) {
        SkyView view;
        view.begin(tables, 0.0, 40.0 * kDegree);
        view.build_all();
        return view.xyz_above(1.57F, 0.0F).y;
    };
    const double gain = static_cast<double>(zenith(snow) / zenith(bare));
    std::printf("zenith over snow: %.2f of that over grass\n", gain);
    EXPECT_GT(gain, 1.15);
    EXPECT_LT(gain, 1.8);
}

}  // namespace
}  // namespace skyig::render::sky
