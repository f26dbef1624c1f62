#include "render/sky/air_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

constexpr std::size_t kGreen = 8;  // 558 nm

double sum_of(const Spectrum& spectrum) {
    return std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
}

TEST(AirModel, SunlightOutsideTheAirHasTheSunsIlluminance) {
    for (const AirModel& model : {atmosphere_a(), atmosphere_b(), air_model({})}) {
        const double lux = sum_of(model.sunlight_xyz_lux[1]);
        std::printf("%.0f lx\n", lux);
        EXPECT_NEAR(lux, 1.323e5, 0.005e5);
    }
}

TEST(AirModel, VisibilityIsTheRangeOfFivePercentContrast) {
    for (const double visibility_m : {1500.0, 5.0e3, 20.0e3, 80.0e3, 200.0e3}) {
        Air air;
        air.visibility_m = visibility_m;
        const AirModel model = air_model(air);
        // The definition holds at 550 nm, between two carried wavelengths.
        const double part = (550.0 - 537.0) / 21.0;
        const double total =
            (1.0 - part) * static_cast<double>(model.rayleigh_per_m[7] + model.aerosol_extinction_per_m[7]) +
            part * static_cast<double>(model.rayleigh_per_m[8] + model.aerosol_extinction_per_m[8]);
        const double contrast = std::exp(-total * visibility_m);
        std::printf(
            "visibility %6.0f m: contrast %.4f, single-scattering albedo %.2f\n", visibility_m, contrast,
            static_cast<double>(model.aerosol_scattering_per_m[8] / model.aerosol_extinction_per_m[8]));
        EXPECT_NEAR(contrast, 0.05, 0.001);
    }
}

TEST(AirModel, MoleculesFollowPressureAndAreAllThatIsLeftWithoutTheModel) {
    Air air;
    air.model_enabled = false;
    const AirModel clean = air_model(air);
    air.pressure_hpa = 0.95 * 1013.25;
    const AirModel thin = air_model(air);
    EXPECT_EQ(sum_of(clean.aerosol_extinction_per_m), 0.0);
    EXPECT_NEAR(thin.rayleigh_per_m[kGreen] / clean.rayleigh_per_m[kGreen], 0.95, 1e-6);
    // Penndorf's table for 15 C, independent of the formula used here, at 548 and 559.75 nm.
    EXPECT_NEAR(clean.rayleigh_per_m[kGreen], 1.096e-5, 0.02e-5);
}

TEST(AirModel, GroundIsDullGreenBrown) {
    const AirModel model = air_model({});
    double reflected = 0.0;
    for (std::size_t i = 0; i < kWavelengths; ++i) {
        EXPECT_GT(model.ground_albedo[i], 0.0F);
        EXPECT_LT(model.ground_albedo[i], 0.4F);
        reflected += static_cast<double>(model.ground_albedo[i] * model.sunlight_xyz_lux[1][i]);
    }
    const double luminous = reflected / sum_of(model.sunlight_xyz_lux[1]);
    std::printf("luminous albedo %.3f\n", luminous);
    EXPECT_NEAR(luminous, 0.1, 0.03);
}

TEST(AirModel, AnyNumberGivesAUsableModel) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const double value : {0.0, -1.0, 1e-300, 1.0, 1e3, 1e9, 1e300, nan, inf, -inf}) {
        Air air;
        air.visibility_m = air.pressure_hpa = air.visibility_contrast = air.temperature_c = air.humidity_pct =
            value;
        const AirModel model = air_model(air);
        for (std::size_t i = 0; i < kWavelengths; ++i) {
            EXPECT_TRUE(std::isfinite(model.aerosol_extinction_per_m[i]));
            EXPECT_GE(model.aerosol_extinction_per_m[i], model.aerosol_scattering_per_m[i]);
            EXPECT_GE(model.aerosol_scattering_per_m[i], 0.0F);
            EXPECT_GT(model.rayleigh_per_m[i], 0.0F);
        }
        EXPECT_GT(model.aerosol_scale_height_m, 100.0);
    }
}

TEST(AirModel, DependsContinuouslyOnVisibility) {
    double largest = 0.0;
    for (const double visibility_m : powers(500.0, 300.0e3, 1.001)) {
        Air air;
        air.visibility_m = visibility_m;
        const AirModel here = air_model(air);
        air.visibility_m = 1.001 * visibility_m;
        const AirModel next = air_model(air);
        const double total =
            static_cast<double>(here.aerosol_extinction_per_m[kGreen] + here.rayleigh_per_m[kGreen]);
        largest = std::max(largest, std::abs(static_cast<double>(next.aerosol_extinction_per_m[kGreen] -
                                                                 here.aerosol_extinction_per_m[kGreen])) /
                                        total);
        largest =
            std::max(largest, std::abs(next.aerosol_scale_height_m / here.aerosol_scale_height_m - 1.0));
    }
    std::printf("largest step for 0.1 %% of visibility: %.5f\n", largest);
    EXPECT_LT(largest, 0.002);
}

}  // namespace
}  // namespace skyig::render::sky
