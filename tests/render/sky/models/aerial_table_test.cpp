// The table of the air before things against the march that it interpolates.
#include "render/sky/models/aerial_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <ctime>
#include <limits>

#include "render/shaders/shared.h"
#include "render/sky/air_data.h"
#include "render/sky/models/day_sky.h"
#include "tests/render/sky/truth.h"
#include "tests/support/allocation_count.h"

namespace skyig::render::sky::models {
namespace {

const AirTables& air_with(double visibility_m, Orders orders) {
    static const AirTables clear(air_model({}));
    static const AirTables clear_first(air_model({}), Orders::kFirst);
    static const auto hazy = [](Orders wanted) {
        Air air;
        air.visibility_m = 10e3;
        return AirTables(air_model(air), wanted);
    };
    static const AirTables hazy_all = hazy(Orders::kAll);
    static const AirTables hazy_first = hazy(Orders::kFirst);
    const bool all = orders == Orders::kAll;
    if (visibility_m < 50e3) return all ? hazy_all : hazy_first;
    return all ? clear : clear_first;
}

SkySettings settings_of(SkyModel model) {
    SkySettings settings;
    settings.model = model;
    return settings;
}

void build(AerialTable& table, const SkySettings& settings, const AirTables& tables, double height_m,
           double source_rad) {
    const std::array sources{source_rad};
    table.begin(settings, tables, height_m, sources);
    while (!table.build_rows(AerialTable::kRows)) {
    }
}

double luminance(const glm::dvec3& rgb) {
    return shaders64::luminance_709(rgb);
}

struct Case {
    const char* name;
    double height_m;
    double visibility_m;
};
constexpr std::array kCases{
    Case{"ground", 2.0, 80e3}, Case{"ground, V = 10 km", 2.0, 10e3}, Case{"3 km", 3000.0, 80e3},
    Case{"11 km", 11e3, 80e3}, Case{"11 km, V = 10 km", 11e3, 10e3}, Case{"400 km", 400e3, 80e3}};

class Aerial : public testing::TestWithParam<SkyModel> {};

// A thing of the brightness of the air's own end: what an error of either part does to its luminance. As far
// as mountains are seen; from space to the horizon.
TEST_P(Aerial, IsTheDirectMarch) {
    const SkySettings settings = settings_of(GetParam());
    AerialTable table;
    for (const Case& c : kCases) {
        const AirTables& tables = air_with(c.visibility_m, orders_of(GetParam()));
        Errors errors;
        for (const double source_deg : {50.0, 5.0, -4.0}) {
            build(table, settings, tables, c.height_m, source_deg * kDeg);
            const double horizon_deg = -tables.data().shell.dip_rad(c.height_m) / kDeg;
            for (const double from_deg : {-60.0, -7.0, -2.3, -0.31, -0.02, 0.17, 0.8, 2.9, 11.0}) {
                for (const double azimuth_deg : {3.0, 100.0, 172.0}) {
                    for (const double distance_m : powers(120.0, c.height_m > 100e3 ? 2.3e6 : 400e3, 2.0)) {
                        RayQuery ray{c.height_m, source_deg * kDeg,
                                     std::max(-90.0, horizon_deg + from_deg) * kDeg, azimuth_deg * kDeg,
                                     distance_m};
                        ray.ground = false;
                        const RayLight whole = ray_light(tables, ray);
                        if (whole.meets_ground) break;
                        const AirBetween exact = air_between(settings, tables, ray);
                        RayQuery end = ray;
                        end.distance_m = std::numeric_limits<double>::infinity();
                        const glm::dvec3 thing(luminance(air_between(settings, tables, end).added_rgb));
                        const AirBetween held =
                            table.between(ray.elevation_rad, ray.relative_azimuth_rad, distance_m);
                        const double truth = luminance(thing * exact.passed_rgb + exact.added_rgb);
                        const double seen = luminance(thing * held.passed_rgb + held.added_rgb);
                        if (truth > 1e-3) errors.add(seen / truth - 1.0);
                    }
                }
            }
        }
        std::printf("%-9s %-17s %5zu rays: p50 %.4f, p99 %.4f, largest %.4f\n",
                    std::string(name_of(GetParam())).c_str(), c.name, errors.count(), errors.quantile(0.5),
                    errors.quantile(0.99), errors.largest());
        if (errors.count() == 0) continue;           // `windlight` has no air in space
        const bool from_space = c.height_m > 100e3;  // rows are coarse over the thin limb above the horizon
        const double bound = GetParam() == SkyModel::kSingle ? 0.1 : 0.03;
        EXPECT_LT(errors.quantile(0.5), 0.002) << c.name;
        EXPECT_LT(errors.quantile(0.99), from_space ? 0.15 : bound) << c.name;
        // The edge of the Earth's shadow across a ray is smoothed: with the first order alone (at 4 deg below
        // the horizon it passes the eye at 11 km), and from space, the largest errors stand there, in faint
        // light.
        if (GetParam() == SkyModel::kMulti && !from_space) {
            EXPECT_LT(errors.largest(), 0.05) << c.name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, Aerial,
                         testing::Values(SkyModel::kMulti, SkyModel::kSingle, SkyModel::kWindlight),
                         [](const auto& chosen) { return std::string(name_of(chosen.param)); });

TEST(AerialTable, NothingNearByAndFiniteForAnything) {
    AerialTable table;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const SkyModel model : {SkyModel::kMulti, SkyModel::kWindlight}) {
        for (const double height_m : {-430.0, 12e3, 120.001e3, nan}) {
            for (const double source : {0.0, nan}) {
                build(table, settings_of(model), air_with(80e3, Orders::kAll), height_m, source);
                for (const double elevation :
                     {-90.0 * kDeg, -0.19, -1e-7, 0.0, 1e-7, 1.0, 90.0 * kDeg, nan, 1e30}) {
                    for (const double distance_m : {-1.0, 0.0, 1e-6, 1.0, 1e5, 1e9, inf, nan}) {
                        const AirBetween seen = table.between(elevation, 0.3, distance_m);
                        for (int k = 0; k < 3; ++k) {
                            ASSERT_TRUE(std::isfinite(seen.added_rgb[k]));
                            ASSERT_TRUE(seen.passed_rgb[k] >= 0.0 && seen.passed_rgb[k] <= 1.0);
                        }
                        if (distance_m <= 0.0) {
                            ASSERT_EQ(seen.added_rgb, glm::dvec3(0.0));
                            ASSERT_EQ(seen.passed_rgb, glm::dvec3(1.0));
                        }
                    }
                }
            }
        }
    }
}

// What visibility means: the contrast of a black ridge before the horizon sky falls to 5 % there.
TEST(AerialTable, ABlackRidgeFadesAsVisibilityPromises) {
    for (const double visibility_m : {10e3, 40e3}) {
        Air air;
        air.visibility_m = visibility_m;
        const AirTables tables(air_model(air));
        AerialTable table;
        build(table, {}, tables, 2.0, 40.0 * kDeg);
        double largest = 0.0;
        for (const double azimuth_deg : {20.0, 90.0, 170.0}) {
            RayQuery sky{2.0, 40.0 * kDeg, 0.0, azimuth_deg * kDeg};
            const double horizon = luminance(air_between({}, tables, sky).added_rgb);
            for (const double part : {0.1, 0.25, 0.5, 1.0, 1.5, 2.5}) {
                const AirBetween ridge = table.between(0.0, sky.relative_azimuth_rad, part * visibility_m);
                const double contrast = 1.0 - luminance(ridge.added_rgb) / horizon;
                largest = std::max(largest, std::abs(contrast - std::exp(-2.996 * part)));
            }
        }
        std::printf("V = %.0f km: contrast of a black ridge off by at most %.4f\n", visibility_m * 1e-3,
                    largest);
        // On a round Earth a level ray leaves the haze: at 40 km it is 125 m up.
        EXPECT_LT(largest, visibility_m > 20e3 ? 0.02 : 0.01);
    }
}

TEST(AerialTable, DoesNotDependOnItsSlicesAndAllocatesNothing) {
    const AirTables& tables = air_with(80e3, Orders::kAll);
    AerialTable whole;
    AerialTable sliced;
    const std::array sources{0.3, -0.2};
    const std::uint64_t before = skyig::tests::allocation_count();
    const std::clock_t start = std::clock();
    whole.begin({}, tables, 500.0, sources);
    whole.build_rows(AerialTable::kRows);
    const double spent_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    sliced.begin({}, tables, 500.0, sources);
    while (!sliced.build_rows(7)) {
    }
    EXPECT_EQ(skyig::tests::allocation_count(), before);
    EXPECT_EQ(whole.extinction(), sliced.extinction());
    for (std::size_t light = 0; light < 2; ++light) {
        EXPECT_EQ(whole.colours(light).rest, sliced.colours(light).rest);
        EXPECT_EQ(whole.colours(light).haze, sliced.colours(light).haze);
    }
    std::printf("build for two lights: %.1f ms of processor time\n", spent_ms);
}

}  // namespace
}  // namespace skyig::render::sky::models
