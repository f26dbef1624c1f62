#include "render/cloud/impostor/particles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/cloud/impostor/noise.h"

namespace skyig::render::cloud::impostor {
namespace {

CloudLayer layer_of(CloudGenus genus, double thickness_m) {
    CloudLayer layer;
    layer.genus = genus;
    layer.thickness_m = thickness_m;
    return layer;
}

TEST(Noise, IsSmoothWithMeanNothingAndTiles) {
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
        const auto n = static_cast<float>(i);
        const glm::vec4 place{0.37F * n, 0.11F * n, 0.73F * n, 0.19F * n};
        const glm::vec4 inside = glm::mod(place, static_cast<float>(kNoisePeriod));
        const float value = gradient_noise(inside, 5U);
        ASSERT_LE(std::abs(value), 1.0F);
        const float beyond = gradient_noise(inside + static_cast<float>(kNoisePeriod), 5U);
        ASSERT_NEAR(value, beyond, 2e-3F);
        const float beside = gradient_noise(inside + glm::vec4{0.001F}, 5U);
        ASSERT_NEAR(value, beside, 0.02F);
        sum += static_cast<double>(value);
        squares += static_cast<double>(value) * static_cast<double>(value);
    }
    EXPECT_EQ(gradient_noise({3.0F, 4.0F, 5.0F, 6.0F}, 5U), 0.0F);
    EXPECT_NEAR(sum / kCount, 0.0, 0.01);
    EXPECT_GT(squares / kCount, 0.01);
}

/// Part of the ground that sees less than half of the light straight above through.
double measured_coverage(const CloudLayer& layer, double coverage) {
    const CloudShape shape = shape_of(layer);
    constexpr int kCells = 24;
    constexpr int kNodes = 10;
    constexpr int kSide = kCells * kNodes;
    const double node_m = shape.cell_m / kNodes;
    std::vector<float> depth(static_cast<std::size_t>(kSide) * kSide);
    std::vector<Particle> room(kMostParticles);
    for (int cell = 0; cell < kCells * kCells; ++cell) {
        const std::uint32_t key = cell_key(cell % kCells, cell / kCells, 11U);
        const std::size_t count = make_particles(shape, key, growth(coverage, key), 0.0, room);
        EXPECT_LT(count, kMostParticles) << "a cloud was cut off";
        const glm::dvec2 corner = glm::dvec2{cell % kCells, cell / kCells} + place_in_cell(key);
        for (std::size_t i = 0; i < count; ++i) {
            const double radius = static_cast<double>(room[i].radius_m) / node_m;
            const glm::dvec2 middle = corner * static_cast<double>(kNodes) +
                                      glm::dvec2{room[i].centre_m.x, room[i].centre_m.y} / node_m;
            const auto first = glm::ivec2{glm::floor(middle - radius)};
            const auto last = glm::ivec2{glm::ceil(middle + radius)};
            for (int y = first.y; y < last.y; ++y) {
                for (int x = first.x; x < last.x; ++x) {
                    const glm::dvec2 away = (glm::dvec2{x, y} + 0.5 - middle) / radius;
                    const double q = 1.0 - glm::dot(away, away);
                    if (q <= 0.0) continue;
                    const int at = (y + kSide) % kSide * kSide + (x + kSide) % kSide;
                    depth[static_cast<std::size_t>(at)] +=
                        room[i].optical_depth * static_cast<float>(std::pow(q, 2.5));
                }
            }
        }
    }
    const auto covered = std::count_if(depth.begin(), depth.end(), [](float d) { return d > 0.6931F; });
    return static_cast<double>(covered) / static_cast<double>(depth.size());
}

TEST(Particles, CoverThePartOfTheGroundThatIsAsked) {
    const std::array<CloudLayer, 2> layers{layer_of(CloudGenus::kCumulus, 400.0),
                                           layer_of(CloudGenus::kCumulonimbus, 8000.0)};
    double worst = 0.0;
    for (const CloudLayer& layer : layers) {
        std::printf("coverage, genus %d, %4.0f m:", static_cast<int>(layer.genus), layer.thickness_m);
        for (const double asked : {0.1, 0.5, 0.9}) {
            const double measured = measured_coverage(layer, asked);
            std::printf("  %.0f -> %.1f %%", 100.0 * asked, 100.0 * measured);
            worst = std::max(worst, std::abs(measured - asked));
        }
        std::printf("\n");
    }
    RecordProperty("worst_points", std::to_string(100.0 * worst));
    EXPECT_LE(worst, 0.03);
    EXPECT_EQ(growth(0.0, cell_key(3, 4, 5U)), 0.0F);
    EXPECT_GT(measured_coverage(layers[0], 1.0), 0.95);
}

TEST(Particles, AreTheSameForTheSameCellAndStayInsideTheirBound) {
    const CloudShape shape = shape_of(layer_of(CloudGenus::kCumulus, 700.0));
    std::vector<Particle> once(kMostParticles);
    std::vector<Particle> again(kMostParticles);
    for (const float grown : {0.05F, 0.5F, 1.0F, 2.0F}) {
        const std::uint32_t key = cell_key(-7, 1LL << 33, 9U);
        const std::size_t count = make_particles(shape, key, grown, 123.0, once);
        ASSERT_EQ(make_particles(shape, key, grown, 123.0, again), count);
        ASSERT_GT(count, 0U);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(once[i].centre_m, again[i].centre_m);
            EXPECT_LE(glm::length(once[i].centre_m) + once[i].radius_m, shape.bound_m);
            EXPECT_GE(once[i].centre_m.z - once[i].radius_m, -0.5F * shape.height_m - 0.7F * shape.radius_m);
            EXPECT_LT(once[i].key, CloudShape::kSizes);
            EXPECT_NEAR(once[i].radius_m, class_radius_m(shape, once[i].key), 0.04F * shape.radius_m);
        }
    }
}

TEST(Particles, GrowAndAgeWithoutAStep) {
    const CloudShape shape = shape_of(layer_of(CloudGenus::kCumulus, 700.0));
    std::vector<Particle> room(kMostParticles);
    const auto total = [&](float grown, double age_s) {
        double sum = 0.0;
        const std::size_t count = make_particles(shape, 77U, grown, age_s, room);
        for (std::size_t i = 0; i < count; ++i)
            sum += static_cast<double>(room[i].optical_depth * room[i].radius_m * room[i].radius_m);
        return sum;
    };
    const double full = total(1.0F, 0.0);
    double worst = 0.0;
    for (int i = 1; i <= 100; ++i) {
        const auto n = static_cast<double>(i);
        const auto grown = static_cast<float>(0.02 * n);
        worst = std::max(worst, std::abs(total(grown, 0.0) - total(grown - 0.02F, 0.0)) / full);
        worst = std::max(worst, std::abs(total(1.0F, 2.0 * n) - total(1.0F, 2.0 * n - 2.0)) / full);
    }
    std::printf("largest step, 1/50 of growth or 2 s: %.2f %% of a full cloud\n", 100.0 * worst);
    EXPECT_LT(worst, 0.08);
}

}  // namespace
}  // namespace skyig::render::cloud::impostor
