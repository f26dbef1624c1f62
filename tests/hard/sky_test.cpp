// The numerically hard cases of the day sky, for every model and for the march that two of them rest on:
// rays level, tangent, straight up and down, to the Sun and away from it; eyes from below the sea to far out
// in space; Suns from the zenith through the horizon into the night.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "render/sky/air_data.h"
#include "render/sky/models/day_sky.h"
#include "render/sky/ray_light.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

using models::DaySky;
using models::orders_of;

constexpr double kTop_m = 120e3;
constexpr std::array kHeights_m{-400.0, 0.0, 2000.0, 20e3, 100e3, kTop_m, 400e3, 36e6};
constexpr std::array kSuns_deg{90.0, 25.0, 0.0, -6.0, -12.0, -18.0};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const AirTables& tables_with(Orders orders) {
    static const AirTables all(air_model({}));
    static const AirTables first(air_model({}), Orders::kFirst);
    return orders == Orders::kAll ? all : first;
}

struct Ray {
    const char* name;
    double elevation_rad;
    double azimuth_rad;
};

std::array<Ray, 9> hard_rays(double horizon_rad, double sun_rad) {
    return {{{"level", 0.0, 1.0},
             {"level to the Sun's azimuth", 0.0, 0.0},
             {"tangent", horizon_rad, 1.0},
             {"just above the ground", horizon_rad + 1e-6, 3.1},
             {"just below the horizon", horizon_rad - 1e-6, 3.1},
             {"up", 90.0 * kDeg, 2.0},
             {"down", -90.0 * kDeg, 2.0},
             {"at the Sun", sun_rad, 0.0},
             {"away from the Sun", -sun_rad, 180.0 * kDeg}}};
}

template <class Vector>
bool is_light(const Vector& xyz) {
    for (int k = 0; k < 3; ++k) {
        if (!std::isfinite(xyz[k]) || !(xyz[k] >= 0)) return false;
    }
    return true;
}

double luminance(const DaySky& sky, double elevation_rad, double azimuth_rad) {
    return static_cast<double>(sky.xyz_above(f32(elevation_rad), f32(azimuth_rad)).y);
}

// Relative; what is fainter than the dark night sky counts as dark.
double change(double a, double b, double floor_cd_m2 = 0.0) {
    constexpr double kDark_cd_m2 = 1e-4;
    return std::abs(a - b) / (std::max(a, b) + std::max(floor_cd_m2, kDark_cd_m2));
}

class HardSky : public testing::TestWithParam<SkyModel> {
  protected:
    void make(DaySky& sky, double height_m, double sun_rad) const {
        SkySettings settings;
        settings.model = GetParam();
        sky.begin(settings, tables_with(orders_of(GetParam())), height_m, sun_rad, true);
        sky.build_all();
    }
};

TEST_P(HardSky, IsFiniteAndNotNegativeAndSmoothAcrossLevelAndTangent) {
    DaySky sky;
    double largest = 0.0;
    std::string where;
    for (const double height_m : kHeights_m) {
        for (const double sun_deg : kSuns_deg) {
            make(sky, height_m, sun_deg * kDeg);
            const double horizon = sky.horizon_elevation_rad();
            double brightest = 0.0;
            for (const double above : {1e-3, 0.02, 0.1, 0.5}) {
                for (const double azimuth : {0.0, 1.0})
                    brightest = std::max(brightest, luminance(sky, horizon + above, azimuth));
            }
            for (const Ray& ray : hard_rays(horizon, sun_deg * kDeg)) {
                const auto e = f32(ray.elevation_rad);
                const auto a = f32(ray.azimuth_rad);
                ASSERT_TRUE(is_light(sky.xyz_above(e, a)) && is_light(sky.xyz_below(e, a)))
                    << ray.name << ' ' << height_m << " m, Sun " << sun_deg;
            }
            for (const double elevation : {0.0, horizon}) {
                const double change_here =
                    change(luminance(sky, elevation - 0.0005 * kDeg, 1.0),
                           luminance(sky, elevation + 0.0005 * kDeg, 1.0), 1e-3 * brightest);
                if (change_here <= largest) continue;
                largest = change_here;
                where = std::to_string(height_m) + " m, Sun " + std::to_string(sun_deg);
            }
        }
    }
    std::printf("%-9s largest change for 0.001 deg across level and horizon: %.5f (%s)\n",
                std::string(name_of(GetParam())).c_str(), largest, where.c_str());
    EXPECT_LT(largest, 0.01);
}

TEST_P(HardSky, LeavesTheAirWithoutAStep) {
    DaySky inside;
    DaySky outside;
    double largest = 0.0;
    for (const double sun_deg : {60.0, 0.0, -6.0}) {
        make(inside, kTop_m - 0.5, sun_deg * kDeg);
        make(outside, kTop_m + 0.5, sun_deg * kDeg);
        double brightest = 0.0;
        const double horizon = inside.horizon_elevation_rad();
        for (const double part : steps(0.0, 1.0, 0.01))
            brightest = std::max(brightest, luminance(inside, horizon * (1.0 - part), 0.7));
        for (const double part : steps(0.0, 1.0, 0.01)) {
            const double elevation = horizon * (1.0 - part);
            largest = std::max(largest, change(luminance(inside, elevation, 0.7),
                                               luminance(outside, elevation, 0.7), 0.01 * brightest));
        }
    }
    std::printf("%-9s largest change for 1 m through the top: %.5f\n",
                std::string(name_of(GetParam())).c_str(), largest);
    EXPECT_LT(largest, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Models, HardSky,
                         testing::Values(SkyModel::kMulti, SkyModel::kSingle, SkyModel::kDayCycle,
                                         SkyModel::kCie, SkyModel::kPreetham, SkyModel::kWindlight),
                         [](const auto& chosen) { return std::string(name_of(chosen.param)); });

class HardRay : public testing::TestWithParam<Orders> {
  protected:
    [[nodiscard]] static double light(const RayQuery& query) {
        return ray_light(tables_with(GetParam()), query).xyz.y;
    }
};

TEST_P(HardRay, IsFiniteAndNotNegativeAtEveryDistanceAndTheSameInSinglePrecision) {
    double largest = 0.0;
    for (const double height_m : kHeights_m) {
        const double horizon = -tables_with(GetParam()).data().shell.dip_rad(std::max(height_m, 0.01));
        for (const double sun_deg : kSuns_deg) {
            for (const Ray& ray : hard_rays(horizon, sun_deg * kDeg)) {
                for (const double distance_m : {0.0, 1e-3, 1e3, 1e5, 1e9, kInfinity}) {
                    const RayQuery query{height_m, sun_deg * kDeg, ray.elevation_rad, ray.azimuth_rad,
                                         distance_m};
                    const RayLight seen = ray_light(tables_with(GetParam()), query);
                    ASSERT_TRUE(is_light(seen.xyz)) << ray.name << ' ' << height_m << ' ' << sun_deg;
                    for (const float part : seen.transmittance)
                        ASSERT_TRUE(part >= 0.0F && part <= 1.0F);
                }
                // Off the horizon, whose far side is another ray.
                const double off = ray.elevation_rad < horizon ? -1e-5 : 1e-5;
                const RayQuery exact{height_m, sun_deg * kDeg, ray.elevation_rad + off, ray.azimuth_rad};
                const RayQuery rounded{
                    static_cast<double>(f32(height_m)), static_cast<double>(f32(exact.source_elevation_rad)),
                    static_cast<double>(f32(exact.elevation_rad)), static_cast<double>(f32(ray.azimuth_rad))};
                largest = std::max(largest, change(light(exact), light(rounded)));
            }
        }
    }
    std::printf("largest change by rounding the ray to single precision: %.5f\n", largest);
    EXPECT_LT(largest, 0.01);
}

TEST_P(HardRay, AirBeforeThingsHasNoStepAcrossTheHorizon) {
    double largest = 0.0;
    for (const double height_m : {2.0, 300.0, 12e3, 100e3, 400e3}) {
        const Shell& shell = tables_with(GetParam()).data().shell;
        const double horizon = -shell.dip_rad(height_m);
        const double horizon_m = std::sqrt(shell.excess_m2(height_m));
        for (const double sun_deg : kSuns_deg) {
            for (const double part : {0.1, 0.4, 0.8}) {
                RayQuery query{height_m, sun_deg * kDeg, horizon - 0.0005 * kDeg, 1.0, part * horizon_m};
                query.ground = false;
                const double below = light(query);
                query.elevation_rad = horizon + 0.0005 * kDeg;
                largest = std::max(largest, change(below, light(query)));
            }
        }
    }
    std::printf("largest change of the air before things across the horizon: %.5f\n", largest);
    EXPECT_LT(largest, 0.01);
}

TEST_P(HardRay, LeavesTheAirWithoutAStep) {
    double largest = 0.0;
    for (const double sun_deg : {60.0, 0.0, -6.0}) {
        for (const double elevation_deg : {-90.0, -30.0, -12.0, -10.95, -9.0, -5.0, -2.0}) {
            RayQuery query{kTop_m - 0.5, sun_deg * kDeg, elevation_deg * kDeg, 0.7};
            const double inside = light(query);
            query.eye_height_m = kTop_m + 0.5;
            largest = std::max(largest, change(inside, light(query)));
        }
    }
    std::printf("largest change of the march for 1 m through the top: %.5f\n", largest);
    EXPECT_LT(largest, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Orders, HardRay, testing::Values(Orders::kAll, Orders::kFirst),
                         [](const auto& chosen) {
                             return std::string(chosen.param == Orders::kAll ? "multi" : "single");
                         });

}  // namespace
}  // namespace skyig::render::sky
