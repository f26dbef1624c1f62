// The dome without GL: what interpolation between its vertices costs in display codes, and that its shape
// holds.
#include "render/dome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "render/eye/tone_curve.h"
#include "render/light_tables.h"
#include "tests/render/dome_colour.h"
#include "tests/render/light_tables_steps.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using tests::kDegree;

TEST(Dome, CoversEveryDirectionWhateverTheHorizon) {
    Dome dome;
    std::mt19937 random{7};
    std::normal_distribution<double> normal;
    for (const double dip_deg : {0.0, 0.01, 3.0, 20.0, 81.0}) {
        for (const double source_deg : {90.0, 5.0, -12.0}) {
            dome.lay_out({-dip_deg * kDegree, 8e-4, source_deg * kDegree, true, 20.0 * kDegree, 2.5, true});
            for (int i = 0; i < 40; ++i) {
                const glm::dvec3 d =
                    glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
                glm::dvec3 colour;
                EXPECT_TRUE(tests::drawn_colour(dome, d, colour))
                    << dip_deg << " " << source_deg << " " << d.z;
            }
        }
    }
}

TEST(Dome, RowsRiseAndTheHorizonLiesBetweenTheEdgeRows) {
    Dome dome;
    for (const double edge_rad : {1e-5, 8e-4, 4e-3, 2e-2}) {
        for (const double source_deg : {90.0, 30.0, 0.0, -18.0}) {
            dome.lay_out({-1.0 * kDegree, edge_rad, source_deg * kDegree, true, 0.0, 0.0, false});
            const auto v = dome.vertices();
            const auto elevation = [&](int row) {
                return std::asin(
                    static_cast<double>(v[static_cast<std::size_t>(row * (Dome::kColumns + 1))].direction.z));
            };
            for (int row = 1; row < Dome::kSkyRows + Dome::kGroundRows; ++row)
                EXPECT_GT(elevation(row), elevation(row - 1))
                    << row << " at " << source_deg << ", " << edge_rad;
            const double below = elevation(Dome::kGroundRows - 1);
            const double above = elevation(Dome::kGroundRows);
            EXPECT_NEAR(above - below, edge_rad, 2e-6);
            EXPECT_NEAR(0.5 * (above + below), -1.0 * kDegree, 2e-6);
        }
    }
}

TEST(Dome, ServesUntilTheHorizonLeavesItsPlaceByATwentiethOfAPixel) {
    const DomeLayout held{-0.02, 1e-3, 0.3, true, 0.0, 0.0, false};
    DomeLayout wanted = held;
    EXPECT_TRUE(still_serves(held, wanted));
    wanted.horizon_elevation_rad += 4e-5;
    EXPECT_TRUE(still_serves(held, wanted));
    wanted.horizon_elevation_rad += 2e-5;
    EXPECT_FALSE(still_serves(held, wanted));
    wanted = held;
    wanted.second_lights = true;
    EXPECT_FALSE(still_serves(held, wanted));
}

TEST(Dome, InterpolatedColoursAreWithinACodeOfTheExactOnes) {
    std::mt19937 random{11};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const auto& named : tests::four_times()) {
        LightTables tables;
        const SkyLight light = tests::step(tables, named.scene);
        const double luminance = std::max(
            1e-4, static_cast<double>(shaders32::luminance_709(light.rgb_cd_m2(0.3, 2.0, Side::kSky))));
        const auto tone = eye::tone_parameters({}, 3.0 * luminance);
        Dome dome;
        dome.lay_out(dome_layout(light, 8e-4));
        dome.shade(light, tone);
        const double turn = dome_azimuth_rad(light);
        std::vector<double> errors;
        for (int i = 0; i < 1500; ++i) {
            // Mostly near the horizon and the source's azimuth, where the sky bends.
            const double elevation = light.horizon_elevation_rad + std::pow(unit(random), 2.0) * 1.5 + 0.002;
            const double from_source = (unit(random) < 0.5 ? -1 : 1) * std::pow(unit(random), 2.0) * 3.1;
            glm::dvec3 drawn;
            ASSERT_TRUE(tests::drawn_colour(dome, direction_of({elevation, from_source}), drawn));
            const glm::dvec3 exact{shaders32::shown(
                light.rgb_cd_m2(elevation, turn + from_source, Side::kSky), eye::single_precision(tone))};
            const glm::dvec3 d = glm::abs(drawn - exact) * 255.0;
            errors.push_back(std::max({d.x, d.y, d.z}));
        }
        std::sort(errors.begin(), errors.end());
        const double p99 = errors[errors.size() * 99 / 100];
        std::printf("%-6s codes: median %.3f, p99 %.3f, largest %.3f\n", named.name.c_str(),
                    errors[errors.size() / 2], p99, errors.back());
        EXPECT_LT(p99, 1.0) << named.name;
        EXPECT_LT(errors.back(), 2.5) << named.name;
    }
}

}  // namespace
}  // namespace skyig::render
