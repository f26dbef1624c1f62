// What is left of light under clouds.
#include "render/cloud_shade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>

#include "render/cloud/slab_light.h"
#include "render/colour.h"
#include "render/deferred.h"
#include "render/light_on_clouds.h"
#include "render/sky_veil.h"
#include "tests/render/cloud/lit_tables.h"

namespace skyig::render {
namespace {

CloudLayer layer(double coverage, double base_m, double thickness_m, double optical_depth) {
    CloudLayer cloud;
    cloud.genus = CloudGenus::kStratus;
    cloud.base_m = base_m;
    cloud.thickness_m = thickness_m;
    cloud.coverage = coverage;
    cloud.extinction_per_m = optical_depth / thickness_m;
    return cloud;
}

Weather weather_of(std::initializer_list<CloudLayer> layers) {
    Weather weather;
    for (const CloudLayer& cloud : layers)
        weather.clouds[weather.cloud_count++] = cloud;
    return weather;
}

// (2 + 3 mu0) / (4 + 3 (1 - g) tau), Eddington: 0.29 and 0.20 for depth 30.
TEST(CloudShade, UnderAnOvercastItIsAsDarkAsEddingtonSays) {
    const CloudShade shade(weather_of({layer(1.0, 1000.0, 500.0, 30.0)}), 0.0);
    EXPECT_NEAR(shade.at(0.0, 1.0).beam, 0.29F, 0.015F);
    EXPECT_NEAR(shade.at(0.0, 0.5).beam, 0.20F, 0.015F);
    EXPECT_LT(shade.at(0.0, 1.0).direct, 1e-6F);
    EXPECT_EQ(shade.at(2000.0, 1.0).beam, 1.0F);
}

TEST(CloudShade, WithoutCoverageNothingChangesBitForBit) {
    for (const double coverage : {0.0, -1.0}) {
        const CloudShade shade(weather_of({layer(coverage, 1000.0, 500.0, 30.0)}), 0.2);
        EXPECT_FALSE(shade.any());
        EXPECT_EQ(shade.at(0.0, 0.3).beam, 1.0F);
    }
    Scene scene;
    scene.sun.direction_enu = {0.0, 0.6, 0.8};
    tests::LitTables lit(scene);
    const SkyLight clear = lit.sky;
    Scene clouded = scene;
    clouded.weather = weather_of({layer(0.0, 1000.0, 500.0, 30.0)});
    lit.follow(clouded);
    for (const double elevation : {-1.0, -0.01, 0.01, 1.0})
        EXPECT_EQ(clear.rgb_cd_m2(elevation, 1.0, Side::kByElevation),
                  lit.sky.rgb_cd_m2(elevation, 1.0, Side::kByElevation));
}

TEST(CloudShade, GroundBelowIsAsDarkAsItsLight) {
    Scene scene;
    scene.eye.height_m = 100.0;
    scene.sun.direction_enu = {0.0, 0.6, 0.8};
    tests::LitTables lit(scene);
    const SkyLight clear = lit.sky;
    scene.weather = weather_of({layer(1.0, 1000.0, 500.0, 30.0)});
    lit.follow(scene);
    const SkyLight& under = lit.sky;
    const auto down = [](const SkyLight& light) { return light.rgb_cd_m2(-1.2, 0.0, Side::kByElevation).y; };
    const float share = down(under) / down(clear);
    std::printf("ground under depth 30: %.3f of the clear day's\n", static_cast<double>(share));
    EXPECT_NEAR(share, CloudShade(scene.weather, 0.1).at(0.0, 0.8).beam, 0.05F);
    // No edge at the horizon.
    const auto at = [&](double above_rad) { return under.sun.clouded.share(above_rad); };
    EXPECT_NEAR(at(1e-9), at(-1e-9), 1e-5F);
}

// Below an overcast the air's light is the cloud's: no blue line along the horizon, on either side of it.
TEST(CloudShade, HorizonUnderAnOvercastHasTheHueOfTheCloud) {
    const auto hue = [](const glm::dvec3& rgb) {
        const glm::dvec3 xyz = kXyzFromRec709 * rgb;
        return glm::dvec2{xyz} / (xyz.x + xyz.y + xyz.z);
    };
    double worst = 0.0, clear = 0.0;
    for (const double visibility_m : {10e3, 20e3, 50e3}) {
        Scene scene;
        scene.air.visibility_m = visibility_m;
        scene.eye.height_m = 300.0;
        scene.sun.direction_enu = {0.0, 0.6, 0.8};
        tests::LitTables lit(scene);
        const auto horizon = [&] {
            return hue(glm::dvec3{lit.sky.smooth_rgb_cd_m2(lit.sky.horizon_elevation_rad, 2.0, Side::kSky)});
        };
        const glm::dvec2 blue = horizon();
        scene.weather = weather_of({layer(1.0, 900.0, 600.0, 30.0)});
        lit.follow(scene);
        cloud::CloudLight on_clouds;
        light_clouds(scene, lit.plan, lit.tables, lit.sky, on_clouds);
        const double share = static_cast<double>(CloudShade(scene.weather, 0.1).at(300.0, 0.8).beam);
        const glm::dvec3 base_cd_m2 =
            share * (glm::dvec3{on_clouds.beam_lx[cloud::CloudLight::kSun][0]} * 0.8 / std::numbers::pi +
                     glm::dvec3{on_clouds.above_cd_m2[0]});
        const glm::dvec2 base = hue(base_cd_m2);
        clear = std::max(clear, glm::distance(blue, base));
        DeferredAir air;
        air.update(scene, lit.plan, lit.tables, lit.sky);
        for (const double azimuth_rad : {0.0, 2.0, 4.0}) {
            for (const double above_deg : {-2.0, -1.5, -1.0, -0.5, -0.1, 0.0, 0.1, 0.5, 1.0, 2.0}) {
                const double elevation_rad = lit.sky.horizon_elevation_rad + glm::radians(above_deg);
                glm::dvec3 seen{lit.sky.smooth_rgb_cd_m2(elevation_rad, azimuth_rad, Side::kByElevation)};
                if (above_deg > 0.0) {
                    const double away_m = 600.0 / std::sin(glm::radians(above_deg));
                    const auto between = air.between(direction_of({elevation_rad, azimuth_rad}), away_m);
                    seen = between.passed_rgb * base_cd_m2 + between.added_rgb;
                }
                worst = std::max(worst, glm::distance(hue(seen), base));
            }
        }
    }
    std::printf("hue within 2 deg of the horizon under 8 oktas: within %.4f of the cloud's, clear %.4f\n",
                worst, clear);
    EXPECT_LT(worst, 0.018);
    EXPECT_GT(clear, 1.8 * worst);
}

// Fog is lit by what the clouds above it let through: as much darker as the ground.
TEST(CloudShade, FogUnderCloudIsAsDarkAsTheGround) {
    Scene scene;
    scene.eye.height_m = 2.0;
    scene.sun.direction_enu = {0.0, 0.6, 0.8};
    scene.weather.obscurants[0] = Obscurant{.top_m = 100.0, .extinction_per_m = 0.015};
    scene.weather.obscurant_count = 1;
    tests::LitTables lit(scene);
    const auto horizon_cd_m2 = [&] {
        SkyVeil veil;
        veil.lay(scene, lit.tables.air(), 1e-3, lit.sky);
        return lit.sky.smooth_rgb_cd_m2(0.001, 0.5, Side::kSky).y;
    };
    const float clear = horizon_cd_m2();
    const CloudLayer above = layer(1.0, 1000.0, 500.0, 30.0);
    scene.weather.clouds[scene.weather.cloud_count++] = above;
    lit.follow(scene);
    const float under = horizon_cd_m2();
    const float share = CloudShade(scene.weather, 0.1).at(100.0, 0.8).beam;
    std::printf("fog under depth 30: %.3f of a clear day's, level light %.3f\n",
                static_cast<double>(under / clear), static_cast<double>(share));
    EXPECT_NEAR(under / clear, share, 0.08F);
}

// The air before a fog is told from the eye down: also where the eye has none round it.
TEST(FogFromAbove, IsSeenThroughAllTheAirFromAnyHeight) {
    Scene scene;
    scene.sun.direction_enu = {0.0, 0.6, 0.8};
    scene.weather.obscurants[0] = Obscurant{.top_m = 100.0, .extinction_per_m = 0.05};
    scene.weather.obscurant_count = 1;
    const auto down_cd_m2 = [&](double height_m) {
        scene.eye.height_m = height_m;
        tests::LitTables lit(scene);
        SkyVeil veil;
        veil.lay(scene, lit.tables.air(), 1e-3, lit.sky);
        for (const double elevation_rad : {-1.5, -1.0, -0.4, -0.05, 0.0, 0.05, 1.5}) {
            const glm::vec3 rgb = lit.sky.smooth_rgb_cd_m2(elevation_rad, 0.5, Side::kByElevation);
            EXPECT_TRUE(std::isfinite(rgb.x + rgb.y + rgb.z)) << height_m << " m, " << elevation_rad;
            EXPECT_LT(rgb.y, 1e5F) << height_m << " m, " << elevation_rad;
        }
        return static_cast<double>(lit.sky.smooth_rgb_cd_m2(-1.57, 0.5, Side::kGround).y);
    };
    const double low = down_cd_m2(50e3);
    for (const double height_m : {59.9e3, 60.1e3, 100e3, 130e3, 400e3, 2000e3, 36000e3}) {
        const double here = down_cd_m2(height_m);
        std::printf("fog straight below %6.0f km: %.0f cd/m2, from 50 km %.0f\n", height_m * 1e-3, here, low);
        EXPECT_NEAR(here / low, 1.0, 0.02) << height_m;
    }
}

// What drops and puddles mirror of an overcast: the flux under it over that of the clear sky.
TEST(CloudShade, WhatIsMirroredOfACoveredSkyIsAsBrightAsItsLight) {
    Scene scene;
    scene.eye.height_m = 100.0;
    scene.sun.direction_enu = {0.0, 0.6, 0.8};
    tests::LitTables lit(scene);
    EXPECT_EQ(lit.sky.overhead, 1.0F);
    const auto mean_up_cd_m2 = [&] {
        double sum = 0.0;
        for (int i = 0; i < 400; ++i) {
            const double elevation_rad = std::asin(std::sqrt((i + 0.5) / 400.0));
            sum += static_cast<double>(lit.sky.covered_rgb_cd_m2(elevation_rad, 2.4 * i, Side::kSky).y);
        }
        return sum / 400.0;
    };
    const double ground_lux = 0.8 * lit.tables.air().direct_sun_xyz(0.0, std::asin(0.8)).y +
                              lit.tables.air().ground_diffuse_xyz(std::asin(0.8)).y;
    scene.weather = weather_of({layer(1.0, 1000.0, 500.0, 30.0)});
    lit.follow(scene);
    const double share = static_cast<double>(CloudShade(scene.weather, 0.1).at(0.0, 0.8).beam);
    EXPECT_NEAR(mean_up_cd_m2() * 3.14159265 / (ground_lux * share), 1.0, 0.1);
}

TEST(CloudShade, IsContinuousInHeightCoverageAndDepth) {
    const auto at = [](double coverage, double depth, double height_m) {
        return CloudShade(
                   weather_of({layer(coverage, 1000.0, 300.0, depth), layer(0.5, 4000.0, 1000.0, 8.0)}), 0.2)
            .at(height_m, 0.6)
            .beam;
    };
    float last = at(1.0, 20.0, 900.0);
    for (int i = 1; i <= 800; ++i) {
        const float now = at(1.0, 20.0, 900.0 + 0.5 * i);
        ASSERT_LT(std::abs(now - last), 0.02F) << i;
        last = now;
    }
    EXPECT_NEAR(at(1e-6, 20.0, 0.0), at(0.0, 20.0, 0.0), 1e-4F);
    EXPECT_NEAR(at(1.0, 1e-6, 0.0), at(0.0, 20.0, 0.0), 1e-4F);
    EXPECT_LT(at(1.0, 20.0, 0.0), at(0.5, 20.0, 0.0));
    EXPECT_LT(at(0.5, 20.0, 0.0), at(0.0, 20.0, 0.0));
}

TEST(CloudShade, LayersOneOverAnotherPassWhatOneAsDeepDoes) {
    const CloudShade two(weather_of({layer(1.0, 1000.0, 300.0, 20.0), layer(1.0, 3000.0, 300.0, 20.0)}), 0.0);
    const CloudShade one(weather_of({layer(1.0, 1000.0, 300.0, 40.0)}), 0.0);
    EXPECT_NEAR(two.at(0.0, 0.7).beam / one.at(0.0, 0.7).beam, 1.0F, 0.1F);
    EXPECT_NEAR(two.at(0.0, 0.7).sky / one.at(0.0, 0.7).sky, 1.0F, 0.1F);
    // Snow sends light up that clouds send back.
    const CloudShade over_snow(weather_of({layer(1.0, 1000.0, 300.0, 40.0)}), 0.8);
    EXPECT_GT(over_snow.at(0.0, 0.7).beam, 1.8F * one.at(0.0, 0.7).beam);
}

TEST(CloudShade, AnAreaElsewhereDimsNothing) {
    CloudLayer storm = layer(1.0, 1000.0, 3000.0, 100.0);
    storm.area = WeatherArea{{30000.0, 0.0}, 0.0, {5000.0, 5000.0}, 1000.0, 2000.0};
    EXPECT_FALSE(CloudShade(weather_of({storm}), 0.1).any());
    storm.area->centre_m = {3000.0, 0.0};
    EXPECT_TRUE(CloudShade(weather_of({storm}), 0.1).any());
}

}  // namespace
}  // namespace skyig::render
