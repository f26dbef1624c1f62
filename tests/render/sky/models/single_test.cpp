// `single` against the order-1 column of the truth tables, and in another planet's air.
#include <gtest/gtest.h>

#include <cstdio>

#include "render/sky/models/day_sky.h"
#include "render/sky/phase.h"
#include "render/sky/ray_light.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky::models {
namespace {

SkySettings settings_of(SkyModel model) {
    SkySettings settings;
    settings.model = model;
    return settings;
}

const SkySettings kSingle = settings_of(SkyModel::kSingle);

class SingleTruth : public testing::TestWithParam<const char*> {};

TEST_P(SingleTruth, AgreesWithTheFirstOrderOfTheTables) {
    const Table table = read_table(std::string(SKYIG_TEST_DATA "/sky/") + GetParam());
    ASSERT_FALSE(table.rows.empty());
    const bool is_a = std::string(GetParam()) == "ground_A.csv";
    const AirTables tables(is_a ? atmosphere_a() : atmosphere_b(), orders_of(SkyModel::kSingle));
    DaySky sky;
    Errors day;
    Errors twilight;
    double built_deg = -1.0;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double sun_deg = table.number(row, "sun_zenith_deg");
        const double truth = table.number(row, "Y_single_cd_m2");
        // The truth's Sun has no disc: on the horizon it is all there, or not at all. Nor does a lid at 60 km
        // serve beyond.
        if (!(truth > 0.0) || sun_deg > 92.5 || sun_deg == 90.0) continue;
        if (sun_deg != built_deg) {
            sky.begin(kSingle, tables, table.number(row, "altitude_m"), (90.0 - sun_deg) * kDeg, true);
            sky.build_all();
            built_deg = sun_deg;
        }
        const float luminance = sky.xyz(f32((90.0 - table.number(row, "view_zenith_deg")) * kDeg),
                                        f32(table.number(row, "rel_azimuth_deg") * kDeg))
                                    .y;
        (sun_deg < 89.0 ? day : twilight).add(static_cast<double>(luminance) / truth - 1.0);
    }
    std::printf(
        "%s: day %zu rows, rms %.2f %%, largest %.1f %%; 89..92.5 %zu rows, rms %.2f %%, largest %.1f %%\n",
        GetParam(), day.count(), 100.0 * day.rms(), 100.0 * day.largest(), twilight.count(),
        100.0 * twilight.rms(), 100.0 * twilight.largest());
    ASSERT_GT(day.count(), 50U);
    EXPECT_LT(day.rms(), 0.02);
    EXPECT_LT(twilight.rms(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Tables, SingleTruth,
                         testing::Values("ground_A.csv", "ground_B.csv", "air_B_10000m.csv",
                                         "air_B_400000m.csv"));

// Thin CO2, bright red dust to the top of the air, ochre ground.
PlanetAir mars() {
    return {.ground_radius_m = 3389.5e3,
            .top_height_m = 110.0e3,
            .molecule_height_m = 11.1e3,
            .rayleigh_per_m = 2.4e-7,
            .aerosol_height_m = 11.1e3,
            .aerosol_per_m = 4.5e-5,
            .aerosol_angstrom = 0.0,
            .aerosol_albedo_blue = 0.76,
            .aerosol_albedo_red = 0.96,
            .aerosol_g = 0.7,
            .ozone_dobson = 0.0,
            .ground_albedo_blue = 0.06,
            .ground_albedo_red = 0.3};
}

TEST(SingleOnMars, AgreesWithTheFlatLayersClosedForm) {
    const AirModel air = planet_air(mars());
    const AirTables tables(air, Orders::kFirst);
    double largest = 0.0;
    for (const double sun_deg : {25.0, 45.0, 60.0}) {
        for (const double view_deg : {35.0, 70.0}) {
            const double mu = std::sin(view_deg * kDeg);
            const double mu_sun = std::sin(sun_deg * kDeg);
            const double cosine =
                mu * mu_sun + std::cos(view_deg * kDeg) * std::cos(sun_deg * kDeg) * std::cos(1.0);
            Spectrum transfer{};
            for (std::size_t i = 0; i < transfer.size(); ++i) {
                const double rayleigh = static_cast<double>(air.rayleigh_per_m[i]) * 11.1e3;
                const double dust = static_cast<double>(air.aerosol_extinction_per_m[i]) * 11.1e3;
                const double scattered = static_cast<double>(air.aerosol_scattering_per_m[i]) * 11.1e3;
                const double depth = rayleigh + dust;
                const double source =
                    rayleigh * rayleigh_phase(cosine) + scattered * cornette_shanks_phase(0.7, cosine);
                transfer[i] = static_cast<float>(source / depth * mu_sun / (mu_sun - mu) *
                                                 (std::exp(-depth / mu_sun) - std::exp(-depth / mu)));
            }
            RayQuery ray;
            ray.source_elevation_rad = sun_deg * kDeg;
            ray.elevation_rad = view_deg * kDeg;
            ray.relative_azimuth_rad = 1.0;
            const double wanted = xyz_of_sunlight(air, transfer).y;
            largest = std::max(largest, std::abs(ray_light(tables, ray).xyz.y / wanted - 1.0));
        }
    }
    std::printf("largest difference %.2f %% (curvature of the ground included)\n", 100.0 * largest);
    EXPECT_LT(largest, 0.015);
}

TEST(SingleOnMars, SkyIsRedderThanSunlightAndSeenFromSpaceTheLimbGlows) {
    const AirModel air = planet_air(mars());
    const AirTables tables(air, Orders::kFirst);
    DaySky sky;
    sky.begin(kSingle, tables, 2.0, 40.0 * kDeg, true);
    sky.build_all();
    Spectrum whole;
    whole.fill(1.0F);
    const glm::dvec3 sunlight = xyz_of_sunlight(air, whole);
    const glm::dvec3 sky_xyz = sky.xyz(f32(60.0 * kDeg), 2.0F);
    EXPECT_GT(sky_xyz.x / sky_xyz.z, 1.1 * sunlight.x / sunlight.z);
    sky.begin(kSingle, tables, 400e3, 10.0 * kDeg, true);
    sky.build_all();
    EXPECT_GT(sky.xyz(f32(sky.horizon_elevation_rad() + 2e-3), 1.0F).y, 10.0F);
    EXPECT_EQ(sky.xyz(0.2F, 1.0F).y, 0.0F);
}

}  // namespace
}  // namespace skyig::render::sky::models
