#include "render/fog/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace skyig::render::fog {
namespace {

const Obscurant kFog{.base_m = -1000.0,
                     .top_m = 40.0,
                     .top_band_m = 10.0,
                     .extinction_per_m = 0.028,
                     .coverage = 0.5,
                     .drift_m = {120.0, -40.0},
                     .seed = 7,
                     .area = WeatherArea{.half_size_m = {500.0, 300.0}}};

TEST(PatchedFog, StandsOnTheGroundWithAllThatTheFogHas) {
    const PatchedFog fog = in_patches(kFog, 0.0);
    EXPECT_EQ(fog.even.extinction_per_m, 0.0);
    EXPECT_EQ(fog.patches.genus, CloudGenus::kFogPatches);
    EXPECT_EQ(fog.patches.model, CloudModel::kAuto);
    EXPECT_EQ(fog.patches.base_m, 0.0);
    EXPECT_EQ(fog.patches.thickness_m, 40.0);
    EXPECT_EQ(fog.patches.bottom_band_m, 0.0);
    EXPECT_EQ(fog.patches.top_band_m, 10.0);
    EXPECT_EQ(fog.patches.coverage, 0.5);
    EXPECT_EQ(fog.patches.extinction_per_m, 0.028);
    EXPECT_EQ(fog.patches.drift_m, kFog.drift_m);
    EXPECT_EQ(fog.patches.seed, 7U);
    EXPECT_EQ(fog.patches.area, kFog.area);
    EXPECT_EQ(in_patches(kFog, -300.0).patches.base_m, -300.0);
}

TEST(PatchedFog, GoesOverIntoEvenFogAsItsGapsClose) {
    double before = 0.0;
    for (int step = 0; step <= 1000; ++step) {
        Obscurant asked = kFog;
        asked.coverage = step / 1000.0;
        const PatchedFog fog = in_patches(asked, 0.0);
        const double patches = fog.patches.coverage > 0.0 ? fog.patches.extinction_per_m : 0.0;
        if (step > 0) {
            EXPECT_NEAR(fog.even.extinction_per_m + patches, 0.028, 1e-15) << step;
        }
        EXPECT_GE(fog.even.extinction_per_m, before);
        EXPECT_LT(fog.even.extinction_per_m - before, 0.04 * 0.028) << step;
        before = fog.even.extinction_per_m;
    }
    EXPECT_EQ(before, 0.028);
}

TEST(PatchedFog, GoesOverIntoItsMeanAsItBecomesDeep) {
    Obscurant asked = kFog;
    asked.top_band_m = 0.0;
    double before = 0.0;
    for (int top_m = 300; top_m <= 3000; top_m += 10) {
        asked.top_m = top_m;
        const PatchedFog fog = in_patches(asked, 0.0);
        const double patches = fog.patches.coverage > 0.0 ? fog.patches.extinction_per_m : 0.0;
        EXPECT_NEAR(fog.even.extinction_per_m + 0.5 * patches, 0.5 * 0.028, 1e-15)
            << "the mean stays: " << top_m;
        EXPECT_GE(fog.even.extinction_per_m, before);
        EXPECT_LT(fog.even.extinction_per_m - before, 0.06 * 0.028) << top_m;
        before = fog.even.extinction_per_m;
        EXPECT_EQ(fog.patches.coverage > 0.0, top_m < 600) << top_m;
    }
}

TEST(PatchedFog, IsOfFogAlone) {
    for (const auto kind : {Obscurant::Kind::kHaze, Obscurant::Kind::kSmoke, Obscurant::Kind::kRain}) {
        Obscurant other = kFog;
        other.kind = kind;
        const PatchedFog fog = in_patches(other, 0.0);
        EXPECT_EQ(fog.patches.coverage, 0.0);
        EXPECT_EQ(fog.even.coverage, 0.5);
        EXPECT_EQ(fog.even.extinction_per_m, 0.028);
    }
    for (const double top_m : {0.0, -100.0}) {
        Obscurant below = kFog;
        below.top_m = top_m;
        EXPECT_EQ(in_patches(below, 0.0).patches.coverage, 0.0);
    }
}

}  // namespace
}  // namespace skyig::render::fog
