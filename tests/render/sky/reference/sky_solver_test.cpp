// The reference solver against the tables of tests/data/sky, a few rows of each; sky_truth_maker does all.
#include "render/sky/reference/sky_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>

#include "tests/render/sky/reference/table_rows.h"

namespace skyig::render::sky::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Effort kQuick{0.004, 2 * kPathsARound, 7};

AirLaw law_of(const std::string& file) {
    return file.find("_A.") != std::string::npos ? atmosphere_a_law() : atmosphere_b_law();
}

class SolverAgainstTable : public testing::TestWithParam<const char*> {};

TEST_P(SolverAgainstTable, AgreesWithinTheStandardErrors) {
    const Table table = read_table(std::string(SKYIG_TEST_DATA "/sky/") + GetParam());
    ASSERT_FALSE(table.rows.empty());
    const Agreement agreement =
        compare_with(table, every_row(table, 19), SkySolver(law_of(GetParam())), kQuick, 2);
    std::printf(
        "%s: %zu rows, %.0f %% within 3 sigma or 1 %%; rms %.2f %%; sigmas rms %.2f, mean %+.2f; "
        "single largest %.3f %%; xy median %.5f\n",
        GetParam(), agreement.rows, 100.0 * agreement.share_within(), 100.0 * agreement.certain.rms(),
        agreement.sigmas.rms(), agreement.mean_sigmas(), 100.0 * agreement.single.largest(),
        agreement.chromaticity.quantile(0.5));
    ASSERT_GE(agreement.rows, 7U);
    EXPECT_GE(agreement.share_within(), 0.95);
    EXPECT_LT(agreement.certain.rms(), 0.01);
    // Errors that are told right are one sigma on average and have no sign.
    EXPECT_LT(agreement.sigmas.rms(), 1.8);
    EXPECT_LT(std::abs(agreement.mean_sigmas()), 3.0 / std::sqrt(static_cast<double>(agreement.rows)));
    EXPECT_LT(agreement.single.largest(), 0.003);
    EXPECT_LT(agreement.chromaticity.quantile(0.5), 0.003);
}

INSTANTIATE_TEST_SUITE_P(Tables, SolverAgainstTable,
                         testing::Values("ground_A.csv", "ground_B.csv", "air_B_10000m.csv",
                                         "air_B_400000m.csv"));

class SolverOnTheGround : public testing::TestWithParam<const char*> {};

TEST_P(SolverOnTheGround, DirectAndDiffuseLightAgreeWithTheTable) {
    const Table table = read_table(std::string(SKYIG_TEST_DATA "/sky/") + GetParam());
    ASSERT_FALSE(table.rows.empty());
    const SkySolver solver(law_of(GetParam()));
    for (std::size_t row = 0; row < table.rows.size(); row += 3) {
        const double sun_deg = table.number(row, "sun_zenith_deg");
        const GroundLight light = solver.ground_light(sun_deg * kDeg, {0.004, 16 * kPathsARound, 3});
        const double direct = table.number(row, "direct_normal_lux");
        const double diffuse = table.number(row, "diffuse_horizontal_lux");
        const double sigma = std::hypot(table.number(row, "rel_se_diffuse"), light.diffuse_error / diffuse);
        std::printf("%s, sun zenith %g: direct %.5g (%.5g), diffuse %.5g (%.5g), %+.2f sigma of %.2f %%\n",
                    GetParam(), sun_deg, light.direct_normal_xyz.y, direct, light.diffuse_xyz.y, diffuse,
                    (light.diffuse_xyz.y / diffuse - 1.0) / sigma, 100.0 * sigma);
        EXPECT_NEAR(light.direct_normal_xyz.y, direct, 2e-4 * direct);
        EXPECT_NEAR(light.diffuse_xyz.y / diffuse, 1.0, std::max(0.01, 3.0 * sigma));
        EXPECT_LT(light.diffuse_error, (sun_deg < 90.0 ? 0.02 : 0.05) * diffuse);
    }
}

INSTANTIATE_TEST_SUITE_P(Tables, SolverOnTheGround, testing::Values("irradiance_A.csv", "irradiance_B.csv"));

TEST(SkySolver, SeesTheMediaOfTheTables) {
    const Table table = read_table(SKYIG_REFERENCE "/sky/atmospheres.csv");
    if (table.rows.empty()) GTEST_SKIP() << "the spectra of the tables are not in this clone";
    ASSERT_EQ(table.rows.size(), kSampleCount);
    const AirLaw a = atmosphere_a_law();
    const AirLaw b = atmosphere_b_law();
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        const double nm = table.number(i, "wavelength_nm");
        const AirOptics of_a = a.optics(nm);
        const AirOptics of_b = b.optics(nm);
        const auto same = [&](double ours, const char* column) {
            EXPECT_NEAR(ours, table.number(i, column), 1e-4 * std::abs(ours)) << column << ' ' << nm;
        };
        same(of_a.rayleigh_per_m, "A_rayleigh_1_per_m");
        same(of_a.aerosol_extinction_per_m, "A_mie_ext_1_per_m");
        same(of_a.aerosol_scattering_per_m, "A_mie_sca_1_per_m");
        same(of_a.ground_albedo, "A_albedo");
        same(of_b.rayleigh_per_m, "B_rayleigh_1_per_m");
        same(of_b.aerosol_extinction_per_m, "B_mie_ext_1_per_m");
        same(of_b.aerosol_scattering_per_m, "B_mie_sca_1_per_m");
        same(of_b.ozone_peak_per_m, "B_ozone_peak_abs_1_per_m");
        same(of_b.ground_albedo, "B_albedo");
        same(a.sunlight_w_m2_nm[i], "A_solar_W_m2_nm");
        same(b.sunlight_w_m2_nm[i], "B_solar_W_m2_nm");
        same(kObserverY[i], "ybar");
    }
}

TEST(SkySolver, AnswersDoNotDependOnTheThreads) {
    const SkySolver solver(atmosphere_b_law());
    const std::vector<View> views = {
        {0.0, 0.5, 0.3, 0.0}, {0.0, 1.5, 1.5, 1.0}, {10e3, 1.5, 1.8, 2.0}, {0.0, 1.2, 1.0, 3.0}};
    const Effort little{0.5, 2 * kPathsARound, 9};
    const std::vector<Radiance> one = solver.radiances(views, little, 1);
    const std::vector<Radiance> three = solver.radiances(views, little, 3);
    for (std::size_t i = 0; i < views.size(); ++i) {
        EXPECT_EQ(one[i].spectral_w_m2_sr_nm, three[i].spectral_w_m2_sr_nm);
        EXPECT_EQ(one[i].luminance_error, three[i].luminance_error);
    }
    const Radiance other = solver.radiance(views[1], {0.5, 2 * kPathsARound, 1234});
    EXPECT_NE(other.xyz.y, one[1].xyz.y);
    EXPECT_NEAR(other.xyz.y, one[1].xyz.y, 5.0 * std::hypot(other.luminance_error, one[1].luminance_error));
}

TEST(SkySolver, HardViewsAreFiniteAndNeverNegative) {
    const SkySolver solver(air_law({}));
    const Effort least{1.0, kPathsARound, 2};
    for (const double height_m : {-400.0, 120e3, 3.6e7}) {
        for (const double sun_rad : {0.0, 0.5 * kPi, 1.9, kPi}) {
            for (const double view_rad : {0.0, 0.5 * kPi, 0.5 * kPi + 1e-6, kPi}) {
                const Radiance light = solver.radiance({height_m, sun_rad, view_rad, 0.0}, least);
                EXPECT_TRUE(std::isfinite(light.xyz.y) && std::isfinite(light.luminance_error));
                for (const double value : light.spectral_w_m2_sr_nm)
                    EXPECT_GE(value, 0.0) << height_m << ' ' << sun_rad << ' ' << view_rad;
                // Above all air, looking up.
                EXPECT_TRUE(light.xyz.y == 0.0 || height_m < 1e6 || view_rad > 2.0);
            }
        }
    }
}

TEST(SkySolver, WithoutAirOnlyTheGroundIsSeen) {
    AirLaw law = atmosphere_b_law();
    law.optics = [](double) { return AirOptics{.rayleigh_per_m = 1e-15, .ground_albedo = 0.3}; };
    const SkySolver solver(law);
    const double sun_rad = 1.0;
    const Radiance sky = solver.radiance({10.0, sun_rad, 0.7, 1.0}, kQuick);
    const Radiance ground = solver.radiance({10.0, sun_rad, kPi, 0.0}, kQuick);
    const double lambert = 0.3 / kPi * std::cos(sun_rad) * xyz_of(law.sunlight_w_m2_nm).y;
    EXPECT_LT(sky.xyz.y, 1e-3);
    EXPECT_NEAR(ground.xyz.y, lambert, 1e-6 * lambert);
}

}  // namespace
}  // namespace skyig::render::sky::reference
