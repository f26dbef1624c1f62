// Told waves: they lie still on the Earth, run as they are told, and leave the sea's mean light as it is.
#include "render/sky/sea_waves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "render/sky/sea_sky.h"
#include "render/sky/sea_surface.h"
#include "render/sky/sea_view.h"
#include "tests/render/scenes.h"

namespace skyig::render::sky {
namespace {

using shaders64::ResolvedSlope;
using shaders64::WaveLight;
using shaders64::WaveTrain;

constexpr double kPi = std::numbers::pi;
using tests::kDegree;
constexpr double kPixel_rad = 8e-4;

Scene choppy(double height_m) {
    Scene scene;
    scene.eye = {47.0, 7.3, height_m};
    tests::add_waves(scene);
    return scene;
}

double turned(double from_rad, double to_rad) {
    return std::remainder(to_rad - from_rad, 2.0 * kPi);
}

TEST(SeaWaves, LieStillOnTheEarthUnderAMovingEye) {
    double worst = 0.0;
    for (const glm::dvec2& at : {glm::dvec2{0.0, 0.0}, glm::dvec2{47.0, 7.3}, glm::dvec2{-33.0, -179.999},
                                 glm::dvec2{71.0, 177.6}, glm::dvec2{-89.0, 12.0}, glm::dvec2{60.0, 180.0}}) {
        Scene scene = choppy(30.0);
        scene.eye.latitude_deg = at.x;
        scene.eye.longitude_deg = at.y;
        const SeaWaves before = sea_waves(scene, kPixel_rad);
        // A hundred metres or so; WGS84's radii of curvature say how many.
        scene.eye.latitude_deg += 7e-4;
        scene.eye.longitude_deg += 5e-4;
        const double sine = std::sin(at.x * kDegree);
        const double w2 = 1.0 - 6.69437999014e-3 * sine * sine;
        const double meridian_m = 6378137.0 * (1.0 - 6.69437999014e-3) / (w2 * std::sqrt(w2));
        const double parallel_m = 6378137.0 / std::sqrt(w2) * std::cos((at.x + 3.5e-4) * kDegree);
        const glm::dvec2 moved_m{parallel_m * 5e-4 * kDegree, meridian_m * 7e-4 * kDegree};
        const SeaWaves after = sea_waves(scene, kPixel_rad);
        ASSERT_EQ(before.count, 4U);
        for (std::size_t i = 0; i < before.count; ++i) {
            const glm::dvec2 number = 0.5 * (before.trains[i].number_rad_m + after.trains[i].number_rad_m);
            const double told = before.trains[i].phase_rad + glm::dot(number, moved_m);
            worst = std::max(worst, std::abs(turned(told, after.trains[i].phase_rad)));
        }
    }
    std::printf("phase under an eye that moved 90 m: off by at most %.1e rad\n", worst);
    EXPECT_LT(worst, 1e-3);
}

TEST(SeaWaves, RunALengthInAPeriodTheWayTheyAreTold) {
    Scene scene = choppy(30.0);
    scene.time_s = 1e6 + 0.1;
    const SeaWaves before = sea_waves(scene, kPixel_rad);
    scene.time_s += 2.1;
    const SeaWaves after = sea_waves(scene, kPixel_rad);
    // Longest first: the second told wave leads.
    const WaveTrain& swell = before.trains[0];
    EXPECT_NEAR(glm::length(swell.number_rad_m), 2.0 * kPi / 110.0, 0.03 * 2.0 * kPi / 110.0);
    EXPECT_NEAR(std::atan2(swell.number_rad_m.x, swell.number_rad_m.y), 0.9, 2.5 * kDegree);
    EXPECT_NEAR(turned(swell.phase_rad, after.trains[0].phase_rad), -2.0 * kPi * 2.1 / 8.4, 1e-6);
    for (std::size_t i = 1; i < before.count; ++i) {
        EXPECT_GT(glm::length(before.trains[i].number_rad_m), glm::length(before.trains[i - 1].number_rad_m));
    }
}

TEST(SeaWaves, CrestLeadsTheMiddleBetweenItsTroughsAndKeepsTheSlopes) {
    for (const double leading : {-1.0, -0.3, 0.0, 0.5, 1.0}) {
        Scene scene = choppy(1.0);
        scene.sea.wave_count = 1;
        scene.sea.waves[0] = {.height_m = 1.0, .length_m = 100.0, .leading_rad = leading};
        WaveTrain train = sea_waves(scene, kPixel_rad).trains[0];
        train.phase_rad = 0.0;
        const double number = glm::length(train.number_rad_m);
        const glm::dvec2 along = train.number_rad_m / number;
        double height = 0.0, crest = 0.0, highest = -1e9, trough = 0.0, lowest = 1e9, squares = 0.0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double phase = 2.0 * kPi * i / kSteps;
            const ResolvedSlope at =
                shaders64::with_train(ResolvedSlope{}, train, along * (phase / number), 0.0);
            const double slope = glm::dot(at.slope, along);
            height += slope * 2.0 * kPi / (kSteps * number);
            squares += slope * slope / kSteps;
            if (height > highest) highest = height, crest = phase;
            if (height < lowest) lowest = height, trough = phase;
        }
        // From the middle between the troughs, half a wave from either.
        EXPECT_NEAR(turned(trough + kPi, crest), leading, 4e-3) << leading;
        const double told = wave_slope(scene.sea.waves[0]);
        EXPECT_NEAR(squares, 0.5 * told * told, 2e-3 * told * told) << leading;
    }
}

TEST(SeaWaves, EndWherePixelsDoNotResolveThem) {
    Scene scene = choppy(30.0);
    EXPECT_EQ(sea_waves(scene, kPixel_rad).count, 4U);
    scene.eye.height_m = 12e3;  // two pixels are 19 m wide
    EXPECT_EQ(sea_waves(scene, kPixel_rad).count, 3U);
    scene.eye.height_m = 400e3;
    EXPECT_EQ(sea_waves(scene, kPixel_rad).count, 0U);
    scene = choppy(30.0);
    scene.sea.waves[0].length_m = NAN;
    scene.sea.waves[1].direction_rad = INFINITY;
    scene.sea.waves[2].height_m = -3.0;
    scene.sea.waves[3].period_s = 0.0;
    const SeaWaves waves = sea_waves(scene, kPixel_rad);
    ASSERT_EQ(waves.count, 1U);
    EXPECT_TRUE(std::isfinite(waves.trains[0].phase_rad));
    // At the depression that ends the pass, the longest train is gone, and before it is not.
    const double number = 2.0 * kPi / 110.0;
    const double sine = least_depression_sine(30.0, number, kPixel_rad);
    for (const double part : {0.999, 1.2}) {
        const double tangent = part * sine / std::sqrt(1.0 - part * part * sine * sine);
        const double footprint = shaders64::footprint_m({30.0 / tangent, 0.0}, 30.0, kPixel_rad);
        EXPECT_EQ(shaders64::resolved_share({number, 0.0}, footprint) > 0.0, part > 1.0);
    }
}

TEST(SeaWaves, NonePopsUpWithHeightHoweverManyAreTold) {
    Scene scene = choppy(30.0);
    const Wave steep{.height_m = 0.2, .length_m = 4.0, .period_s = 1.6, .direction_rad = 2.4};
    const Wave gentle{.height_m = 2.5, .length_m = 200.0, .period_s = 11.3, .direction_rad = 0.2};
    for (const Wave& wave : {gentle, steep})
        scene.sea.waves[scene.sea.wave_count++] = wave;
    const auto resolved_below_the_eye = [&](double height_m) {
        scene.eye.height_m = height_m;
        glm::dvec3 sum{0.0};
        for (const WaveTrain& train : sea_waves(scene, kPixel_rad).all()) {
            const double share = shaders64::resolved_share(train.number_rad_m, height_m * kPixel_rad);
            const glm::dvec2 rise = share * train.rise;
            sum += glm::dvec3{rise.x * rise.x, rise.y * rise.y, rise.x * rise.y};
        }
        return sum;
    };
    glm::dvec3 last = resolved_below_the_eye(10.0);
    const double all = last.x + last.y;
    double worst = 0.0;
    for (double height_m = 10.0; height_m < 200e3; height_m *= 1.005) {
        const glm::dvec3 now = resolved_below_the_eye(height_m);
        worst = std::max(worst, glm::length(now - last) / all);
        last = now;
    }
    std::printf("half a percent of height: %.4f of the drawn slopes come or go at most\n", worst);
    EXPECT_GT(all, 0.0);
    EXPECT_LT(worst, 0.02);
}

TEST(SeaWaves, LeaveRoughnessWhereverTheyStandAndWhateverTheWind) {
    Scene scene;
    scene.ground.kind = Ground::Kind::kSea;
    scene.sea.wave_count = 1;
    double least = 1.0;
    double closing = 0.0;
    for (const double wind_m_s : {0.0, 0.5, 8.0}) {
        scene.ground.wind_m_s = wind_m_s;
        for (double latitude_deg = -85.0; latitude_deg <= 85.0; latitude_deg += 5.0) {
            for (double longitude_deg = -2.5; longitude_deg <= 2.5; longitude_deg += 0.25) {
                scene.eye = {latitude_deg, longitude_deg, 20.0};
                closing = std::max(closing, std::abs(sea_anchor(scene.eye).closing));
                for (const double direction_deg : {0.0, 45.0, 90.0, 135.0, 200.0}) {
                    scene.sea.waves[0] = {.height_m = 2.84,
                                          .length_m = 20.0,
                                          .period_s = 3.6,
                                          .direction_rad = direction_deg * kDegree,
                                          .leading_rad = 0.4};
                    const SeaWaves waves = sea_waves(scene, kPixel_rad);
                    const ResolvedSlope all =
                        shaders64::with_train(ResolvedSlope{}, waves.trains[0], {}, 0.0);
                    const double e = waves.variance.east_east - all.variance.x;
                    const double n = waves.variance.north_north - all.variance.y;
                    const double en = waves.variance.east_north - all.variance.z;
                    // The smaller eigenvalue of what is left.
                    least = std::min(least, 0.5 * (e + n) - std::hypot(0.5 * (e - n), en));
                }
            }
        }
    }
    std::printf("parallels close by up to %.4f; roughness left: at least %.5f\n", closing, least);
    EXPECT_GT(closing, 0.04);
    // Calm water's 0.0015 (Cox and Munk) and a slope of 1 deg.
    EXPECT_NEAR(least, 0.0018, 1e-6);
}

TEST(SlopeDensity, IsFiniteEvenOfAVarianceThatIsNone) {
    for (const glm::dvec3& variance : {glm::dvec3{0.01, 0.01, 0.02}, glm::dvec3{-0.01, 0.02, 0.0},
                                       glm::dvec3{0.0, 0.0, 0.0}, glm::dvec3{-1.0, -1.0, -0.5}}) {
        for (const glm::dvec2& slope : {glm::dvec2{0.0, 0.0}, glm::dvec2{0.3, 0.3}, glm::dvec2{0.3, -0.3}}) {
            const double density = shaders64::slope_density(slope, variance);
            EXPECT_GE(density, 0.0);
            // No more than that of the smoothest surface.
            EXPECT_LE(density, 1.001 / (2.0 * kPi * 3e-4));
        }
    }
}

struct SeaUnderTest {
    SeaSurface surface;
    SeaView view;
    glm::dvec3 variance;
    glm::dvec3 source;
};

const AirTables& sea_air() {
    static const AirTables tables(air_model({}, choppy(30.0).ground));
    return tables;
}

SeaUnderTest sea_under_test(const Scene& scene, double source_deg) {
    const SlopeVariance told = slope_variance(scene.ground, scene.sea.all_waves());
    const SlopeVariance v = roughened(told);
    SeaUnderTest sea{SeaSurface(told),
                     {},
                     {v.east_east, v.north_north, v.east_north},
                     {0.0, std::cos(source_deg * kDegree), std::sin(source_deg * kDegree)}};
    sea.view.begin(sea_air(), sea.surface, scene.eye.height_m, source_deg * kDegree);
    sea.view.build_rows(SeaView::kRows);
    return sea;
}

WaveLight light_at(const SeaUnderTest& sea, double elevation_rad, double azimuth_rad) {
    const SeaView::OfSlopes slopes = sea.view.of_slopes(elevation_rad, azimuth_rad, 0.0);
    const glm::dvec3 smooth{sea.view.xyz(elevation_rad, azimuth_rad, 0.0) -
                            slopes.density * slopes.glitter_xyz};
    return {smooth, slopes.east_xyz, slopes.north_xyz, glm::dvec3{slopes.bend} / smooth.y,
            slopes.glitter_xyz};
}

TEST(SeaWaves, LeaveTheMeanOfManyAsItIs) {
    const Scene scene = choppy(30.0);
    const SeaWaves waves = sea_waves(scene, kPixel_rad);
    double worst = 0.0;
    for (const double source_deg : {60.0, 30.0, 12.0}) {
        const SeaUnderTest sea = sea_under_test(scene, source_deg);
        for (const double below_deg : {8.0, 15.0, 30.0, 60.0}) {
            for (const double azimuth_deg : {0.0, 20.0, 90.0, 180.0}) {
                const double azimuth = azimuth_deg * kDegree;
                const WaveLight light = light_at(sea, -below_deg * kDegree, azimuth);
                const glm::dvec3 to_eye{-std::cos(below_deg * kDegree) * std::sin(azimuth),
                                        -std::cos(below_deg * kDegree) * std::cos(azimuth),
                                        std::sin(below_deg * kDegree)};
                const glm::dvec2 mirroring = shaders64::mirroring_slope(to_eye, sea.source);
                double sum = 0.0;
                constexpr int kPoints = 20000;
                for (int i = 0; i < kPoints; ++i) {
                    // The R2 sequence over 20 km each way.
                    const glm::dvec2 at_m{2e4 * std::fmod(i * 0.7548776662466927, 1.0),
                                          2e4 * std::fmod(i * 0.5698402909980532, 1.0)};
                    ResolvedSlope slope{};
                    for (const WaveTrain& train : waves.all())
                        slope = shaders64::with_train(slope, train, at_m, 0.5);
                    sum += shaders64::wave_lit(light, slope, mirroring, sea.variance).y;
                }
                const auto mean = static_cast<double>(sea.view.xyz(-below_deg * kDegree, azimuth, 0.0).y);
                worst = std::max(worst, std::abs(sum / (kPoints * mean) - 1.0));
            }
        }
    }
    std::printf("mean light of resolved waves: off by at most %.4f\n", worst);
    EXPECT_LT(worst, 0.03);
}

// What one tilted patch of water sends of the sky, by a dense sum over the facets that the wind leaves on it.
double tilted_sky(const SeaUnderTest& sea, const SeaSky& sky, double below_rad, const glm::dvec2& tilt,
                  double rough) {
    const double level = std::cos(below_rad);
    const double up = std::sin(below_rad);
    const glm::dvec3 view{-level, 0.0, up};
    double sum = 0.0;
    const auto add = [&](const glm::dvec2& s, double density) {
        const glm::dvec3 across{-s.x, -s.y, 1.0};
        const double area = std::max(0.0, glm::dot(across, view));
        const glm::dvec3 normal = glm::normalize(across);
        const glm::dvec3 r = 2.0 * glm::dot(normal, view) * normal - view;
        const double cosine = r.x / std::max(std::hypot(r.x, r.y), 1e-9);
        sum += density * area * fresnel_reflectance(glm::dot(normal, view)) *
               static_cast<double>(sky.xyz(static_cast<float>(std::abs(r.z)), static_cast<float>(cosine)).y);
    };
    double seen = 0.0;
    constexpr int kSteps = 40;
    for (int i = -kSteps; i <= kSteps; ++i) {
        for (int j = -kSteps; j <= kSteps; ++j) {
            const glm::dvec2 z = 4.0 / kSteps * glm::dvec2{i, j};
            const double density = std::exp(-0.5 * glm::dot(z, z)) / (2.0 * kPi) * 16.0 / (kSteps * kSteps);
            add(tilt + rough * z, density);
            // All slopes of the sea, for the area that the eye sees of it.
            seen += density * std::max(0.0, up + level * sea.surface.facet_slope() * z.x);
        }
    }
    return sum / seen;
}

TEST(SeaWaves, TiltedWaterSendsWhatADenseSumOverItsFacetsSays) {
    const Scene scene = choppy(30.0);
    const SeaUnderTest sea = sea_under_test(scene, 40.0);
    const SeaSky sky(sea_air().data(), sea.source.z);
    const double rough = 0.8 * sea.surface.facet_slope();
    const double handed = 0.5 * (sea.variance.x + sea.variance.y) * (1.0 - 0.64);
    double worst = 0.0;
    double worst_flat = 0.0;
    for (const double below_deg : {8.0, 15.0, 30.0, 60.0}) {
        const double below = below_deg * kDegree;
        WaveLight light = light_at(sea, -below, 0.0);
        // The sky's part alone.
        light.glitter = glm::dvec3{0.0};
        const double mean = tilted_sky(sea, sky, below, {}, sea.surface.facet_slope());
        light.bend *= light.smooth_part.y / mean;
        light.smooth_part = glm::dvec3{mean};
        for (const double tilt : {-0.12, -0.06, 0.06, 0.12}) {
            for (const glm::dvec2& along : {glm::dvec2{1.0, 0.0}, glm::dvec2{0.0, 1.0}}) {
                // Looking north: away from the eye is north, its right is east.
                const ResolvedSlope slope{{tilt * along.y, tilt * along.x}, {handed, handed, 0.0}};
                const double found = shaders64::wave_lit(light, slope, {}, glm::dvec3{1.0, 1.0, 0.0}).y;
                const double exact = tilted_sky(sea, sky, below, tilt * along, rough);
                worst = std::max(worst, std::abs(found / exact - 1.0));
                worst_flat = std::max(worst_flat, std::abs(mean / exact - 1.0));
            }
        }
    }
    std::printf("sky in tilted water: off by at most %.3f, a level sea by %.3f\n", worst, worst_flat);
    EXPECT_LT(worst, 0.1);
    EXPECT_GT(worst_flat, 0.3);
}

}  // namespace
}  // namespace skyig::render::sky
