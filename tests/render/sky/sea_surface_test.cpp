// The wavy mirror: against closed values, and its energy in two coordinates that share no formula.
#include "render/sky/sea_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace skyig::render::sky {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

Ground windy(double wind_m_s, double from_deg = 0.0) {
    Ground ground;
    ground.kind = Ground::Kind::kSea;
    ground.wind_m_s = wind_m_s;
    ground.wind_from_rad = from_deg * kDegree;
    return ground;
}

glm::dvec3 source_at(double elevation_deg, double from_view_deg) {
    const double level = std::cos(elevation_deg * kDegree);
    return {level * std::cos(from_view_deg * kDegree), level * std::sin(from_view_deg * kDegree),
            std::sin(elevation_deg * kDegree)};
}

TEST(SeaSurface, FresnelIsThatOfWater) {
    const double straight = (kSeaIndex - 1.0) / (kSeaIndex + 1.0);
    EXPECT_NEAR(fresnel_reflectance(1.0), straight * straight, 1e-15);
    EXPECT_DOUBLE_EQ(fresnel_reflectance(0.0), 1.0);
    // At Brewster's angle only light polarised along the surface comes back: sin^2(2 incidence - 90 deg) / 2.
    const double brewster = std::atan(kSeaIndex);
    const double across = std::cos(2.0 * brewster);
    EXPECT_NEAR(fresnel_reflectance(std::cos(brewster)), 0.5 * across * across, 1e-15);
    for (double c = 0.0; c < 1.0; c += 0.01)
        EXPECT_GT(fresnel_reflectance(c), fresnel_reflectance(c + 0.01)) << c;
}

TEST(SeaSurface, SlopesAreThoseOfWindAndWaves) {
    // Cox and Munk's lines for a clean surface, along and across the wind, added.
    for (const double wind : {0.0, 1.0, 5.0, 10.0, 14.0})
        EXPECT_NEAR(slope_variance(windy(wind), {}).total(), 0.003 + 0.00508 * wind, 1e-12) << wind;
    const SlopeVariance breeze = slope_variance(windy(1.0, 30.0), {});
    EXPECT_DOUBLE_EQ(breeze.east_east, breeze.north_north) << "the path of a low Sun would turn aside";
    EXPECT_NEAR(breeze.east_north, 0.0, 1e-15);
    const SlopeVariance north = slope_variance(windy(10.0), {});
    EXPECT_GT(north.north_north, 1.3 * north.east_east);
    const SlopeVariance east = slope_variance(windy(10.0, 90.0), {});
    EXPECT_NEAR(east.east_east, north.north_north, 1e-12);
    EXPECT_NEAR(slope_variance(windy(10.0, 45.0), {}).east_north, 0.5 * (0.0316 - 0.0222), 1e-12);
    // Mean square of the slope of 1 m of swell, 50 m long, taken along the wave.
    double mean_square = 0.0;
    constexpr int kPoints = 1000;
    for (int i = 0; i < kPoints; ++i) {
        const double slope = kPi * 1.0 / 50.0 * std::cos(2.0 * kPi * i / kPoints);
        mean_square += slope * slope / kPoints;
    }
    const Wave swell{.height_m = 1.0, .length_m = 50.0, .direction_rad = 0.5 * kPi};
    const SlopeVariance with = slope_variance(windy(0.0), std::array{swell});
    EXPECT_NEAR(with.east_east - slope_variance(windy(0.0), {}).east_east, mean_square, 1e-9);
    const Wave wall{.height_m = 1e9, .length_m = 1.0};
    EXPECT_LT(slope_variance(windy(0.0), std::array{wall}).total(), 0.11);
    const Wave broken{.height_m = NAN, .length_m = 0.0, .direction_rad = NAN};
    EXPECT_TRUE(std::isfinite(slope_variance(windy(NAN, NAN), std::array{broken}).total()));
}

// Sunlight of unit irradiance on a level square metre, and what of it comes back, over all directions.
double sent_back(const SeaSurface& sea, double source_deg, double azimuth_deg) {
    constexpr int kRows = 150;
    constexpr int kColumns = 180;
    double sum = 0.0;
    for (int i = 0; i < kRows; ++i) {
        // Close together on the horizon.
        const double root = (i + 0.5) / kRows;
        const double elevation = 0.5 * kPi * root * root;
        double ring = 0.0;
        for (int j = 0; j < kColumns; ++j) {
            // And on the source's azimuth: the path of a low one is narrow.
            const double half_turns = 2.0 * (j + 0.5) / kColumns - 1.0;
            const double relative_deg = 180.0 * half_turns * std::abs(half_turns);
            ring += 2.0 * std::abs(half_turns) *
                    sea.glitter_per_sr(std::sin(elevation), (azimuth_deg - relative_deg) * kDegree,
                                       source_at(source_deg, relative_deg));
        }
        sum += ring * std::sin(elevation) * std::cos(elevation) * 2.0 * root;
    }
    return sum * (0.5 * kPi / kRows) * (2.0 * kPi / kColumns) / std::sin(source_deg * kDegree);
}

// The same by facets: each catches light in proportion to the area that it turns to the source.
double mirrored(const SeaSurface& sea, double source_deg) {
    const SlopeVariance& v = sea.variance();
    const double determinant = v.east_east * v.north_north - v.east_north * v.east_north;
    const glm::dvec3 source{0.0, std::cos(source_deg * kDegree), std::sin(source_deg * kDegree)};
    double sum = 0.0;
    double lit = 0.0;
    constexpr double kStep = 0.01;
    for (double east = -1.2; east < 1.2; east += kStep) {
        for (double north = -1.2; north < 1.2; north += kStep) {
            const double density = std::exp(-0.5 *
                                            (v.north_north * east * east + v.east_east * north * north -
                                             2.0 * v.east_north * east * north) /
                                            determinant) /
                                   (2.0 * kPi * std::sqrt(determinant));
            const glm::dvec3 across{-east, -north, 1.0};
            const double caught = std::max(0.0, glm::dot(across, source)) * density * kStep * kStep;
            lit += caught;
            sum += caught * fresnel_reflectance(glm::dot(across, source) / glm::length(across));
        }
    }
    return sum / lit;
}

// What leaves the same surface if light goes from wave to wave until it does: random walks between
// uncorrelated Gaussian facets (Heitz, Hanika, d'Eon and Dachsbacher 2016). \return both, and by way of one
// facet alone
struct Walked {
    double all = 0.0;
    double single = 0.0;
};
Walked walked(double slope, double source_deg, int walks) {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> normal(0.0, slope);
    const auto lambda_up = [slope](double up) {
        const double nu = up / (std::sqrt(2.0) * slope * std::sqrt(std::max(1e-12, 1.0 - up * up)));
        return nu > 6.0 ? 0.0 : 0.5 * (std::exp(-nu * nu) / (nu * std::sqrt(kPi)) - std::erfc(nu));
    };
    const auto lambda = [&](double up) { return up >= 0.0 ? lambda_up(up) : -1.0 - lambda_up(-up); };
    Walked sum;
    for (int i = 0; i < walks; ++i) {
        glm::dvec3 way = -source_at(source_deg, 0.0);
        double below = 1.0;  // share of the surface that lies lower
        double energy = 1.0;
        for (int bounce = 0; bounce < 12; ++bounce) {
            const double l = lambda(way.z == 0.0 ? 1e-9 : way.z);
            const double chance = 1.0 - unit(random);
            if (way.z > 0.0 && (l < 1e-9 || chance < std::pow(below, l))) {
                sum.all += energy / walks;
                if (bounce == 1) sum.single += energy / walks;
                break;
            }
            below = std::clamp(below / std::pow(chance, 1.0 / l), 1e-12, 1.0);
            // A facet, in proportion to the area that it turns to the light.
            const double most = std::max(0.0, -way.z) + 5.0 * slope * std::hypot(way.x, way.y);
            glm::dvec3 across;
            do {
                across = {-normal(random), -normal(random), 1.0};
            } while (-glm::dot(across, way) < unit(random) * most);
            across = glm::normalize(across);
            const double cosine = -glm::dot(across, way);
            energy *= fresnel_reflectance(cosine);
            way += 2.0 * cosine * across;
        }
    }
    return sum;
}

TEST(SeaSurface, GlitterSendsBackWhatLightThatGoesFromWaveToWaveDoes) {
    double worst = 0.0;
    for (const double wind : {1.0, 5.0, 15.0}) {
        const double each = 0.5 * slope_variance(windy(wind), {}).total();
        const SeaSurface sea(SlopeVariance{each, each, 0.0});
        for (const double source_deg : {5.0, 10.0, 20.0, 45.0, 90.0}) {
            const double back = sent_back(sea, source_deg, 0.0);
            const Walked truth = walked(sea.facet_slope(), source_deg, 30000);
            const double facets = mirrored(sea, source_deg);
            std::printf(
                "wind %4.1f sun %4.1f: glitter %.4f, walked %.4f (one wave %.4f, facets %.4f), ratio %.3f\n",
                wind, source_deg, back, truth.all, truth.single, facets, back / truth.all);
            worst = std::max(worst, std::abs(back / truth.all - 1.0));
        }
    }
    std::printf("glitter's energy: off by at most %.3f\n", worst);
    EXPECT_LT(worst, 0.05);
}

TEST(SeaSurface, MeanReflectanceOfFacetsIsThatOfADenseSum) {
    double worst = 0.0;
    for (const double wind : {0.5, 5.0, 15.0}) {
        // Without direction, as the facets are taken.
        const double each = 0.5 * slope_variance(windy(wind), {}).total();
        const SeaSurface sea(SlopeVariance{each, each, 0.0});
        for (const double view_deg : {0.5, 2.0, 5.0, 15.0, 40.0, 90.0}) {
            const double mean = sea.mean_reflectance(std::sin(view_deg * kDegree));
            worst = std::max(worst, std::abs(mean / mirrored(sea, view_deg) - 1.0));
        }
    }
    std::printf("mean reflectance: largest relative error %.4f\n", worst);
    EXPECT_LT(worst, 0.02);
}

TEST(SeaSurface, HorizonOfARoughSeaReflectsFarLessThanAMirror) {
    const SeaSurface breeze(slope_variance(windy(5.0), {}));
    const SeaSurface gale(slope_variance(windy(15.0), {}));
    EXPECT_LT(breeze.mean_reflectance(0.0), 0.6);
    EXPECT_LT(gale.mean_reflectance(0.0), breeze.mean_reflectance(0.0));
    EXPECT_GT(gale.mean_reflectance(0.0), 0.1);
}

TEST(SeaSurface, GlitterIsBrightestNearTheMirrorAndBoundedEverywhere) {
    const SeaSurface sea(slope_variance(windy(3.0), {}));
    const glm::dvec3 sun = source_at(40.0, 0.0);
    double brightest_deg = 0.0;
    double brightest = 0.0;
    for (double e = 1.0; e < 90.0; e += 0.5) {
        const double value = sea.glitter_per_sr(std::sin(e * kDegree), 0.0, sun);
        if (value > brightest) {
            brightest = value;
            brightest_deg = e;
        }
    }
    // Grazing facets count for more: the brightest point lies on the horizon's side of the mirror.
    EXPECT_GT(brightest_deg, 30.0);
    EXPECT_LT(brightest_deg, 41.0);
    // No brighter than the source itself: the Sun's disc fills 6.8e-5 sr.
    for (const double wind : {0.0, 1.0, 25.0}) {
        const SeaSurface any(slope_variance(windy(wind), {}));
        for (const double up : {0.0, 1e-9, 1e-3, 0.5, 1.0}) {
            for (const double source_deg : {-90.0, -0.3, 0.0, 1e-6, 3.0, 90.0}) {
                for (const double azimuth_deg : {0.0, 90.0, 180.0}) {
                    const double value = any.glitter_per_sr(up, 1.0, source_at(source_deg, azimuth_deg));
                    EXPECT_TRUE(std::isfinite(value) && value >= 0.0 && value < 1.0 / 6.8e-5)
                        << wind << " " << up << " " << source_deg << " " << azimuth_deg << ": " << value;
                }
            }
        }
    }
}

}  // namespace
}  // namespace skyig::render::sky
