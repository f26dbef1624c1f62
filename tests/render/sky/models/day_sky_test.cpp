// Every model, asked as the renderer asks: finite, never by accident black, and without a step.
#include "render/sky/models/day_sky.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <limits>

#include "render/sky/air_tables.h"
#include "tests/render/sky/truth.h"
#include "tests/support/allocation_count.h"

namespace skyig::render::sky::models {
namespace {

const AirTables& tables_for(SkyModel model) {
    static const AirTables all(air_model({}));
    static const AirTables first(air_model({}), Orders::kFirst);
    return orders_of(model) == Orders::kAll ? all : first;
}

SkySettings settings_of(SkyModel model) {
    SkySettings settings;
    settings.model = model;
    return settings;
}

// Enough for what does not ask how true it is.
constexpr SkyViewSize kSmall{.sky_rows = 24, .ground_rows = 12, .columns = 17, .steps = 24};

class EveryModel : public testing::TestWithParam<SkyModel> {
  protected:
    void make(DaySky& sky, double height_m, double source_deg) const {
        sky.begin(settings_, tables_for(GetParam()), height_m, source_deg * kDeg, true);
        sky.build_all();
    }
    SkySettings settings_ = settings_of(GetParam());
};

bool is_light(const glm::vec3& xyz) {
    for (int k = 0; k < 3; ++k) {
        if (!std::isfinite(xyz[k]) || xyz[k] < 0.0F) return false;
    }
    return true;
}

TEST_P(EveryModel, IsFiniteInHardCases) {
    DaySky sky(kSmall);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double height_m : {-430.0, 0.0, 2.0, 12e3, 100e3, 120e3, 400e3, 3.6e7, nan}) {
        for (const double source_deg : {90.0, 30.0, 0.0, -0.3, -6.0, -18.0, -90.0, nan}) {
            make(sky, height_m, source_deg);
            const double horizon = sky.horizon_elevation_rad();
            for (const double elevation : {90.0 * kDeg, source_deg * kDeg, 1e-6, 0.0, horizon, horizon - 1e-6,
                                           -90.0 * kDeg, 1e30, nan}) {
                for (const double azimuth : {0.0, 1e-7, 3.2, -9.0, 1e6, nan}) {
                    const float e = f32(elevation);
                    const float a = f32(azimuth);
                    ASSERT_TRUE(is_light(sky.xyz_above(e, a)) && is_light(sky.xyz_below(e, a)))
                        << height_m << ' ' << source_deg << ' ' << elevation << ' ' << azimuth;
                }
            }
        }
    }
}

TEST_P(EveryModel, IsLightByDayAndInTwilightAndDarkByNight) {
    DaySky sky(kSmall);
    for (const double height_m : {2.0, 12e3}) {
        for (const double source_deg : {90.0, 60.0, 20.0, 3.0, 0.0, -4.0}) {
            make(sky, height_m, source_deg);
            for (const double elevation_deg : {90.0, 45.0, 10.0, 1.0, 0.2}) {
                const float y = sky.xyz(f32(elevation_deg * kDeg), 1.0F).y;
                EXPECT_GT(y, source_deg < -1.0 ? 1e-3F : 0.5F)
                    << height_m << ' ' << source_deg << ' ' << elevation_deg;
                EXPECT_LT(y, 2e5F);
            }
            // Of light scattered once, nothing is left on the ground once the Sun has set.
            if (source_deg < 3.0) continue;
            EXPECT_GT(sky.xyz(f32(-60.0 * kDeg), 1.0F).y, 10.0F);
        }
    }
    make(sky, 2.0, -25.0);
    EXPECT_LT(sky.xyz(0.5F, 1.0F).y, 1e-4F);
}

double largest_step(const DaySky& a, const DaySky& b, double move_rad = 0.0) {
    double largest = 0.0;
    for (const double from_horizon : {1.0, 0.3, 0.05, 0.003, -0.003, -0.05, -0.5}) {
        for (const double azimuth : {0.3, 1.5, 3.1}) {
            const auto y = [&](const DaySky& sky, double more) {
                return static_cast<double>(
                    sky.xyz(f32(sky.horizon_elevation_rad() + from_horizon + more), f32(azimuth)).y);
            };
            const double first = y(a, 0.0);
            largest = std::max(largest, std::abs(y(b, move_rad) - first) / (first + 1e-3));
        }
    }
    return largest;
}

TEST_P(EveryModel, HasNoStepOverTheSunsElevation) {
    DaySky here(kSmall);
    DaySky there(kSmall);
    double largest = 0.0;
    for (const double source_deg :
         {89.999, 45.0, 10.0005, 3.0005, 0.0, -0.2, -1.0, -6.0, -12.0, -18.0, -89.99}) {
        make(here, 100.0, source_deg);
        make(there, 100.0, source_deg - 0.001);
        largest = std::max(largest, largest_step(here, there));
    }
    std::printf("largest relative change for 0.001 deg of the Sun: %.4f\n", largest);
    // With the first order alone the last of the Sun's disc sets on air that nothing else lights.
    EXPECT_LT(largest, orders_of(GetParam()) == Orders::kFirst ? 0.025 : 0.01);
}

TEST_P(EveryModel, HasNoStepOverTheEyesHeight) {
    DaySky here(kSmall);
    DaySky there(kSmall);
    double largest = 0.0;
    for (const double height_m : {100.0, 1500.0, 20e3, 48e3, 90e3, 114e3, 119.9995e3, 200e3}) {
        make(here, height_m, 20.0);
        make(there, height_m + 1.0, 20.0);
        largest = std::max(largest, largest_step(here, there));
    }
    std::printf("largest relative change for 1 m of height: %.5f\n", largest);
    // At 100 m the ground 0.2 deg below the horizon comes nearer by 1 %.
    EXPECT_LT(largest, 0.01);
}

TEST_P(EveryModel, GoesThroughTheTopOfTheAirWithoutAStep) {
    DaySky here(kSmall);
    DaySky there(kSmall);
    make(here, 119.9995e3, 20.0);
    make(there, 120.0005e3, 20.0);
    double brightest = 1e-3;  // cd/m2; some of the formulas have nothing left up there
    double largest = 0.0;
    for (const double part : steps(0.01, 1.0, 0.01)) {
        const auto y = [&](const DaySky& sky) {
            return static_cast<double>(
                sky.xyz_above(f32(sky.horizon_elevation_rad() * (1.0 - part)), 1.0F).y);
        };
        brightest = std::max(brightest, y(here));
        largest = std::max(largest, std::abs(y(here) - y(there)));
    }
    std::printf("largest change for 1 m through the top: %.1e of the brightest\n", largest / brightest);
    EXPECT_LT(largest / brightest, 0.001);
}

TEST_P(EveryModel, HasNoStepAcrossTheLevelOrTheZenith) {
    DaySky sky(kSmall);
    double largest = 0.0;
    for (const double height_m : {2.0, 3000.0}) {
        for (const double source_deg : {50.0, 2.0, -5.0}) {
            make(sky, height_m, source_deg);
            for (const double azimuth : {0.5, 2.0}) {
                for (const double elevation_deg : {0.0, 0.5729, 5.0, 89.9995}) {
                    const auto y = [&](double at) {
                        return static_cast<double>(sky.xyz_above(f32(at * kDeg), f32(azimuth)).y);
                    };
                    const double first = y(elevation_deg - 0.0005);
                    largest = std::max(largest, std::abs(y(elevation_deg + 0.0005) / first - 1.0));
                }
            }
        }
    }
    std::printf("largest relative change for 0.001 deg of elevation: %.5f\n", largest);
    EXPECT_LT(largest, 0.01);
}

TEST_P(EveryModel, AllocatesOnlyInItsConstructor) {
    const AirTables& tables = tables_for(GetParam());
    DaySky sky(kSmall);
    DaySky other(kSmall);
    float sum = 0.0F;
    const std::uint64_t before = skyig::tests::allocation_count();
    for (const double source_rad : {0.5, 0.499, -0.05}) {
        sky.begin(settings_, tables, 1000.0, source_rad, true);
        while (!sky.build_rows(5)) {
        }
        std::swap(sky, other);
        sum += other.xyz(0.3F, 0.4F).y + other.xyz(-0.3F, 0.4F).y;
    }
    EXPECT_EQ(skyig::tests::allocation_count(), before);
    EXPECT_GT(sum, 0.0F);
}

struct Medium {
    const char* file;
    AirModel air;
};

const AirTables& truth_tables(const AirModel& air, Orders orders) {
    static std::vector<AirTables> made;
    for (const AirTables& tables : made) {
        if (tables.orders() == orders && tables.model() == air) return tables;
    }
    made.reserve(4);
    return made.emplace_back(air, orders);
}

// One row of the table in docs/models.md for each file.
TEST_P(EveryModel, ErrorAgainstTheTruthTables) {
    constexpr double kLargestRms[] = {0.02, 0.35, 0.35, 0.6, 2.5, 1.5};
    for (const auto& [file, air] :
         {Medium{"ground_A.csv", atmosphere_a()}, Medium{"ground_B.csv", atmosphere_b()}}) {
        const Table table = read_table(std::string(SKYIG_TEST_DATA "/sky/") + file);
        const AirTables& tables = truth_tables(air, orders_of(GetParam()));
        Errors by_range[3];
        Errors colour;
        DaySky sky;
        double built_deg = -1.0;
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            const double sun_deg = table.number(row, "sun_zenith_deg");
            if (sun_deg > 92.5 || table.number(row, "rel_se_Y") > 0.02) continue;
            if (sun_deg != built_deg) {
                sky.begin(settings_, tables, 0.0, (90.0 - sun_deg) * kDeg, true);
                sky.build_all();
                built_deg = sun_deg;
            }
            const glm::dvec3 xyz = sky.xyz(f32((90.0 - table.number(row, "view_zenith_deg")) * kDeg),
                                           f32(table.number(row, "rel_azimuth_deg") * kDeg));
            const double sum = std::max(xyz.x + xyz.y + xyz.z, 1e-30);
            by_range[sun_deg < 82.0 ? 0 : (sun_deg < 89.0 ? 1 : 2)].add(xyz.y / table.number(row, "Y_cd_m2") -
                                                                        1.0);
            colour.add(
                std::hypot(xyz.x / sum - table.number(row, "x"), xyz.y / sum - table.number(row, "y")));
        }
        std::printf("%-9s %s: rms luminance %.1f / %.1f / %.1f %%, median dxy %.4f\n",
                    std::string(name_of(GetParam())).c_str(), file, 100.0 * by_range[0].rms(),
                    100.0 * by_range[1].rms(), 100.0 * by_range[2].rms(), colour.quantile(0.5));
        EXPECT_LT(by_range[0].rms(), kLargestRms[static_cast<std::size_t>(GetParam())]);
        EXPECT_LT(colour.quantile(0.5), 0.05);
    }
}

TEST_P(EveryModel, CostOfALookUp) {
    DaySky sky;
    make(sky, 100.0, 30.0);
    constexpr int kCount = 20000;
    double least_ns = 1e9;
    float sum = 0.0F;
    for (int round = 0; round < 5; ++round) {
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < kCount; ++i)
            sum +=
                sky.xyz_above(static_cast<float>(i % 1571) * 1e-3F, static_cast<float>(i % 3141) * 1e-3F).y;
        const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
        least_ns = std::min(least_ns, spent.count() / kCount);
    }
    std::printf("%-9s look-up %.0f ns\n", std::string(name_of(GetParam())).c_str(), least_ns);
    EXPECT_GT(sum, 0.0F);
    EXPECT_LT(least_ns, 1e5);
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel,
                         testing::Values(SkyModel::kMulti, SkyModel::kSingle, SkyModel::kDayCycle,
                                         SkyModel::kCie, SkyModel::kPreetham, SkyModel::kWindlight),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

TEST(DaySky, CieTakesAMeasuredZenithFromTheSunAlone) {
    SkySettings settings = settings_of(SkyModel::kCie);
    settings.cie = {.type = 5, .zenith_luminance_cd_m2 = 7000.0};
    const AirTables& tables = tables_for(SkyModel::kCie);
    DaySky sky;
    sky.begin(settings, tables, 0.0, 0.5, true);
    EXPECT_NEAR(sky.xyz(1.5707F, 0.0F).y, 7000.0F, 1.0F);
    EXPECT_NEAR(sky.xyz(0.2F, 2.0F).y, 7000.0F, 1.0F);  // type 5 is uniform
    sky.begin(settings, tables, 0.0, 0.5, false);
    const float of_multi = sky.xyz(1.5707F, 0.0F).y;
    EXPECT_LT(of_multi, 6000.0F);
    sky.begin(settings, tables, 0.0, -6.0 * kDeg, true);
    EXPECT_LT(sky.xyz(1.5707F, 0.0F).y, 200.0F);
    EXPECT_GT(sky.xyz(1.5707F, 0.0F).y, 1.0F);
}

TEST(DaySky, CieOvercastIsDarkerAtTheHorizonTowardsTheSunToo) {
    SkySettings settings = settings_of(SkyModel::kCie);
    settings.cie.type = 16;
    DaySky sky;
    sky.begin(settings, tables_for(SkyModel::kCie), 0.0, 0.5, true);
    EXPECT_NEAR(sky.xyz(0.0F, 0.0F).y / sky.xyz(1.5707F, 0.0F).y, 1.0F / 3.0F, 1e-3F);
}

TEST(DaySky, EverySkyTypeOfTheStandardIsFinite) {
    DaySky sky;
    for (int type = 1; type <= 16; ++type) {
        SkySettings settings = settings_of(SkyModel::kCie);
        settings.cie.type = type;
        for (const double source_rad : {1.5, 0.0, -0.3}) {
            sky.begin(settings, tables_for(SkyModel::kCie), 0.0, source_rad, true);
            for (const double elevation : steps(-1.5, 1.57, 0.1))
                ASSERT_TRUE(is_light(sky.xyz(f32(elevation), 0.0F))) << type;
        }
    }
}

}  // namespace
}  // namespace skyig::render::sky::models
