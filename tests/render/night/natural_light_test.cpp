// The sources of a dark sky, each by its own law.
#include "render/night/natural_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "render/night/airglow.h"
#include "render/night/light_dome.h"
#include "render/night/milky_way_map.h"
#include "render/night/starlight.h"
#include "render/night/zodiacal_light.h"
#include "tests/csv.h"

namespace skyig::render::night {
namespace {

using skyig::tests::read_csv;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

TEST(ZodiacalLight, NodesAreTheTables) {
    double largest = 0.0;
    for (const auto& row : read_csv(SKYIG_TEST_DATA "/night/zodiacal_s10.csv")) {
        for (const int b : {0, 5, 10, 15, 20, 25, 30, 45, 60, 75, 90}) {
            const double known = row.number("b" + std::to_string(b));
            if (std::isnan(known)) continue;
            const double ours = zodiacal_s10(row.number("dlon_deg") * kDegree, -b * kDegree);
            largest = std::max(largest, std::abs(ours / known - 1.0));
        }
    }
    std::printf("largest difference %.1e\n", largest);
    EXPECT_LT(largest, 1e-9);
    // Past the table's edge light goes on rising to the Sun.
    EXPECT_GT(zodiacal_s10(0.0, 0.0), zodiacal_s10(10.0 * kDegree, 0.0));
    EXPECT_GT(zodiacal_s10(10.0 * kDegree, 0.0), zodiacal_s10(15.0 * kDegree, 0.0));
}

TEST(Airglow, FollowsVanRhijnFromTheGroundAndIsSeenFromAbove) {
    for (const double zenith_deg : {0.0, 30.0, 60.0, 80.0}) {
        const double ratio = 6371.0 / 6461.0 * std::sin(zenith_deg * kDegree);
        const double law = 1.0 / std::sqrt(1.0 - ratio * ratio);
        const AirglowPath path = airglow_path((90.0 - zenith_deg) * kDegree, 0.0, false);
        EXPECT_NEAR((path.far + path.near) / law, 1.0, 0.02) << zenith_deg;
    }
    EXPECT_EQ(airglow_path(0.5 * kPi, 400e3, false).far, 0.0);  // nothing above
    const AirglowPath down = airglow_path(-0.5 * kPi, 400e3, true);
    EXPECT_NEAR(down.near, 1.0, 0.01);
    EXPECT_EQ(down.far, 0.0);
    // The layer's limb is many times as bright as the layer from above.
    const double limb_rad = -std::acos(6461e3 / 6771e3);
    EXPECT_GT(airglow_path(limb_rad - 0.005, 400e3, false).near, 8.0);
}

TEST(Starlight, FitFollowsThePioneersMaps) {
    const auto rows = read_csv(SKYIG_REFERENCE "/night/starlight_pioneer_s10.csv");
    if (rows.empty()) GTEST_SKIP() << "the map of starlight is not in this clone";
    double weights = 0.0, squares = 0.0, known_sum = 0.0, ours_sum = 0.0;
    for (const auto& row : rows) {
        const double b = row.number("b_deg");
        const double weight = std::cos(b * kDegree) * (std::abs(b) <= 24.0 ? 4.0 : 10.0);
        for (int l = 0; l < 360; l += 10) {
            const double known = row.number("l" + std::to_string(l));
            const Starlight light = starlight_s10(l * kDegree, b * kDegree);
            const double off = std::log((light.even + light.belt) / known);
            weights += weight;
            squares += weight * off * off;
            known_sum += weight * known;
            ours_sum += weight * (light.even + light.belt);
        }
    }
    const double rms = std::sqrt(squares / weights);
    std::printf("rms of the logarithm %.3f, whole sky %.3f of the map's\n", rms, ours_sum / known_sum);
    EXPECT_LT(rms, 0.21);
    EXPECT_NEAR(ours_sum / known_sum, 1.0, 0.03);
}

TEST(MilkyWayMap, DetailLeavesPhotometryAlone) {
    MilkyWayMap map;
    map.begin(1.0, 7);
    for (int slice = 0; !map.build_rows(5); ++slice)
        ASSERT_LT(slice, 100);
    double largest = 0.0, detail = 0.0;
    int count = 0;
    for (double b0 = -15.0; b0 < 15.0; b0 += 10.0) {
        for (double l0 = 0.0; l0 < 360.0; l0 += 20.0) {
            double ours = 0.0, smooth = 0.0;
            for (double b = b0 + 0.25; b < b0 + 10.0; b += 0.5) {
                for (double l = l0 + 0.25; l < l0 + 20.0; l += 0.5) {
                    const glm::dvec3 direction{std::cos(b * kDegree) * std::cos(l * kDegree),
                                               std::cos(b * kDegree) * std::sin(l * kDegree),
                                               std::sin(b * kDegree)};
                    const double here = map.luminance_cd_m2(direction);
                    const double mean = kS10_cd_m2 * starlight_s10(l * kDegree, b * kDegree).belt;
                    ours += here;
                    smooth += mean;
                    detail += std::abs(here / mean - 1.0);
                    ++count;
                }
            }
            largest = std::max(largest, std::abs(ours / smooth - 1.0));
        }
    }
    std::printf("means over 10 x 20 deg within %.3f; mean size of the detail %.2f\n", largest,
                detail / count);
    EXPECT_LT(largest, 0.2);
    EXPECT_GT(detail / count, 0.15);
}

TEST(MilkyWayMap, SameSeedGivesTheSameMapAndTheSeamIsClosed) {
    MilkyWayMap a, b, c;
    a.begin(1.0, 3);
    b.begin(1.0, 3);
    c.begin(1.0, 4);
    a.build_rows(MilkyWayMap::kHeight);
    while (!b.build_rows(7)) {
    }
    c.build_rows(MilkyWayMap::kHeight);
    EXPECT_TRUE(std::equal(a.texels().begin(), a.texels().end(), b.texels().begin()));
    EXPECT_FALSE(std::equal(a.texels().begin(), a.texels().end(), c.texels().begin()));
    for (const double b_deg : {-20.0, 0.0, 8.0}) {
        const auto at = [&](double l) {
            const double y = b_deg * kDegree;
            return a.luminance_cd_m2({std::cos(y) * std::cos(l), std::cos(y) * std::sin(l), std::sin(y)});
        };
        EXPECT_NEAR(at(1e-7) / at(-1e-7), 1.0, 1e-4);
    }
    EXPECT_NEAR(MilkyWayMap::unwarped(MilkyWayMap::warped(3e-4)), 3e-4, 1e-15);
}

// Walker (1977): light 45 deg up towards a town of P heads is 0.01 P D^-2.5 of the natural sky, D in km.
TEST(LightDome, FallsWithDistanceAsWalkerFound) {
    const TownAir air;
    constexpr double kNatural_cd_m2 = 2e-4;
    const City town{.radius_m = 4000.0, .population = 2e5};
    const auto glow = [&](double distance_m) {
        return town_glow_cd_m2(town_lumen(town, air), town.radius_m, air, distance_m, 0.0, 45.0 * kDegree,
                               0.0);
    };
    const double slope = std::log(glow(60e3) / glow(15e3)) / std::log(4.0);
    const double walker = 0.01 * town.population * std::pow(30.0, -2.5) * kNatural_cd_m2;
    std::printf("falls with the power %.2f of distance (Walker -2.5); at 30 km %.2f of his law\n", slope,
                glow(30e3) / walker);
    EXPECT_NEAR(slope, -2.5, 0.5);
    EXPECT_LT(std::abs(std::log(glow(30e3) / walker)), std::log(2.0));
}

TEST(LightDome, TableIsTheFormulaAndStandsOverTheTown) {
    const TownAir air;
    const City town{.radius_m = 8000.0, .zenith_cd_m2 = 6e-3};
    const double lumen = town_lumen(town, air);
    LightDome dome;
    dome.aim(town, air, 30e3, 500.0);
    for (int slice = 0; !dome.build_rows(7); ++slice)
        ASSERT_LT(slice, 10);
    double largest = 0.0;
    for (const double elevation_deg : {1.0, 5.0, 17.0, 40.0, 88.0}) {
        for (const double azimuth_deg : {0.0, 4.0, 33.0, 100.0, 175.0}) {
            const double exact = town_glow_cd_m2(lumen, town.radius_m, air, 30e3, 500.0,
                                                 elevation_deg * kDegree, azimuth_deg * kDegree);
            const double ours = dome.luminance_cd_m2(elevation_deg * kDegree, azimuth_deg * kDegree);
            largest = std::max(largest, std::abs(ours / exact - 1.0));
        }
    }
    std::printf("table within %.3f of the formula\n", largest);
    EXPECT_LT(largest, 0.06);
    EXPECT_GT(dome.luminance_cd_m2(0.05, 0.0), 10.0 * dome.luminance_cd_m2(0.5 * kPi, 0.0));
    EXPECT_NEAR(town_glow_cd_m2(lumen, town.radius_m, air, 0.0, 0.0, 0.5 * kPi, 0.0), 6e-3, 1e-9);
}

TEST(LightDome, KeepsItsRowsWhileTheyServe) {
    const TownAir air;
    const City town{.radius_m = 8000.0, .population = 1e5};
    LightDome dome;
    const auto kept = [&](const City& city, const TownAir& in, double distance_m, double height_m) {
        dome.aim(town, air, 30e3, 1000.0);
        dome.build_rows(LightDome::kRows);
        dome.aim(city, in, distance_m, height_m);
        return dome.complete();
    };
    EXPECT_TRUE(kept(town, air, 30.2e3, 1010.0));
    EXPECT_FALSE(kept(town, air, 31e3, 1000.0));
    EXPECT_FALSE(kept(town, air, 30e3, 1030.0));
    EXPECT_FALSE(kept(town, {2e-5, 2e-5}, 30e3, 1000.0));
    EXPECT_FALSE(kept({.radius_m = 8000.0, .population = 2e5}, air, 30e3, 1000.0));
}

TEST(LightDome, GlowHardlyChangesWithinAStepOfHeight) {
    const TownAir air;
    double largest = 0.0;
    for (const double height_m : {1e3, 3e3, 10e3}) {
        for (const double distance_m : {2e3, 15e3, 60e3}) {
            for (const double elevation_deg : {0.5, 5.0, 30.0, 85.0}) {
                const auto glow = [&](double at_m) {
                    return town_glow_cd_m2(1e9, 8000.0, air, distance_m, at_m, elevation_deg * kDegree, 0.2);
                };
                const double next_m = height_m + LightDome::height_step_m(height_m);
                largest = std::max(largest, std::abs(std::log(glow(next_m) / glow(height_m))));
            }
        }
    }
    std::printf("a step of height changes the glow by up to %.3f\n", largest);
    EXPECT_LT(largest, 0.03);
    EXPECT_GT(largest, 0.01);
}

// The most that a configuration may ask for.
TEST(LightDome, EightThousandHeadsAKm2AreAtMostTwoHundredthsOfACandela) {
    const TownAir air;
    double brightest = 0.0;
    for (const double radius_m : {100.0, 1e3, 8e3, 30e3, 100e3}) {
        const City town{.radius_m = radius_m, .population = 8e-3 * kPi * radius_m * radius_m};
        brightest = std::max(brightest,
                             town_glow_cd_m2(town_lumen(town, air), radius_m, air, 0.0, 0.0, 0.5 * kPi, 0.0));
    }
    std::printf("zenith over the town: up to %.4f cd/m2\n", brightest);
    EXPECT_LT(brightest, 0.02);
    EXPECT_GT(brightest, 0.01);
}

TEST(NaturalLight, SwitchesTakeTheirShare) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3{0.2, -0.4, 0.7});
    const glm::dvec3 sun{1.0, 0.0, 0.0};
    const auto green = [&](const NightSettings& settings) {
        return beyond_air_cd_m2(settings, direction, sun).y;
    };
    NightSettings zodiacal, stars, galactic;
    zodiacal.starlight = zodiacal.galactic_light = false;
    stars.zodiacal = stars.galactic_light = false;
    galactic.zodiacal = galactic.starlight = false;
    EXPECT_NEAR(green(zodiacal) + green(stars) + green(galactic), green({}), 1e-12);
    EXPECT_NEAR(green(galactic) / green(stars), kGalacticLightShare / (1.0 - kGalacticLightShare), 1e-9);
    NightSettings none = zodiacal;
    none.zodiacal = false;
    EXPECT_EQ(green(none), 0.0);
}

}  // namespace
}  // namespace skyig::render::night
