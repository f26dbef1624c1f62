#include "render/cloud/impostor/light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "render/cloud/impostor/noise.h"
#include "render/cloud/impostor/picture.h"
#include "render/sky/phase.h"
#include "tests/csv.h"
#include "tests/render/cloud/impostor/moments.h"

namespace skyig::render::cloud::impostor {
namespace {

constexpr glm::vec3 kZenith{0.0F, 0.0F, 1.0F};

Shading shading_of(LightMethod method, const glm::vec3& towards = kZenith) {
    std::array<Beam, CloudLight::kSources> beams{};
    beams[CloudLight::kSun] = {true, towards};
    return {method, beams};
}

struct Column {
    CloudShape shape;
    std::vector<Particle> particles;
    std::vector<Lit> lit;
};

/// Straight over one another, in no order.
Column column_of(std::size_t count, float depth_each) {
    Column column;
    column.shape = shape_of({});
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t rank = i * 7 % count;
        const float height = (static_cast<float>(rank) / static_cast<float>(count) - 0.5F) * 700.0F;
        column.particles.push_back(
            {glm::vec3{0.0F, 0.0F, height}, column.shape.radius_m, depth_each, CloudShape::kSizes - 1U});
    }
    column.lit.resize(count);
    return column;
}

void light(Column& column, const Shading& shading) {
    LightBuffer buffer;
    buffer.light(column.shape, column.particles, shading, column.lit);
}

TEST(LightBuffer, HandsOnTheProductOfWhatParticlesLetThrough) {
    // Each takes 1/50, as in the seed: with 8 bits the light would stop falling at a tenth.
    constexpr float kEach = 0.0202F;
    Column column = column_of(251, kEach);
    light(column, shading_of(LightMethod::kProduct));
    float worst = 0.0F;
    for (std::size_t i = 0; i < column.particles.size(); ++i) {
        const auto before = static_cast<float>(250 - i * 7 % 251);
        const float truth = std::exp(-kEach * before);
        worst = std::max(worst, std::abs(column.lit[i].beams[CloudLight::kSun] / truth - 1.0F));
    }
    std::printf("product of 250: worst relative error %.3f %%\n", 100.0 * static_cast<double>(worst));
    // Sixteen bits cut off, 250 times.
    EXPECT_LT(worst, 0.08F);
    EXPECT_LT(column.lit[0].beams[CloudLight::kSun], 0.02F);
}

TEST(LightBuffer, GathersWhatIsScatteredOnForward) {
    constexpr float kEach = 0.2F;
    Column product = column_of(20, kEach);
    Column gathered = product;
    light(product, shading_of(LightMethod::kProduct));
    light(gathered, shading_of(LightMethod::kGather));
    // I_k / I_{k-1} = T + (1 - T) p(l, l) gamma / (4 pi).
    const double passed = std::exp(-static_cast<double>(kEach));
    const double gain = (1.0 - passed) * 1.5 * 0.09 / (4.0 * std::numbers::pi);
    const double truth = std::pow(1.0 + gain / passed, 19.0);
    const double measured = static_cast<double>(gathered.lit[0].beams[CloudLight::kSun]) /
                            static_cast<double>(product.lit[0].beams[CloudLight::kSun]);
    std::printf("gathered over product after 19: %.4f, closed form %.4f\n", measured, truth);
    EXPECT_NEAR(measured, truth, 0.01);
}

TEST(LightBuffer, TellsHowMuchCloudLiesOnEachSide) {
    constexpr float kEach = 1.5F;
    Column column = column_of(41, kEach);
    light(column, shading_of(LightMethod::kDepths, glm::normalize(glm::vec3{1e-7F, 0.0F, 1.0F})));
    for (std::size_t i = 0; i < column.particles.size(); ++i) {
        const auto rank = static_cast<float>(i * 7 % 41);
        EXPECT_NEAR(column.lit[i].above, kEach * (40.0F - rank), 0.04F * kEach * 40.0F);
        EXPECT_NEAR(column.lit[i].below, kEach * rank, 0.04F * kEach * 40.0F);
        EXPECT_NEAR(column.lit[i].beams[CloudLight::kSun], column.lit[i].above, 0.5F);
    }
}

TEST(Shading, KeepsEvenLightEven) {
    const Shading shading = shading_of(LightMethod::kDepths);
    for (const float above : {0.0F, 1.0F, 30.0F, 170.0F}) {
        const Texel texel = shading.colour({{1.0F, 0.0F}, above, 40.0F}, {0.0F, 1.0F, 0.0F});
        EXPECT_NEAR(texel.v[kFromAbove] + texel.v[kFromBelow], 1.0F, 1e-4F);
        EXPECT_GE(texel.v[kSunlight], 0.0F);
        EXPECT_EQ(texel.v[kMoonlight], 0.0F);
    }
}

/// A box of particles that looks like an endless slab from its middle.
Column slab_of(float optical_depth) {
    Column slab;
    constexpr int kAcross = 16;
    constexpr int kLevels = 4;
    constexpr float kSpacing = 100.0F;
    constexpr float kOverlap = 1.2F;
    CloudShape& shape = slab.shape;
    shape.spacing_m = kSpacing;
    shape.radius_m = kOverlap * kSpacing / 0.975F;
    shape.bound_m = 1300.0F;
    const float radius = class_radius_m(shape, CloudShape::kSizes - 1U);
    // Depth of a column: particles per area times the integral of one over its disc, 2 pi r^2 / 7.
    const float per_depth = 2.0F * std::numbers::pi_v<float> / 7.0F * radius * radius /
                            (kSpacing * kSpacing) * static_cast<float>(kLevels);
    for (int i = 0; i < kAcross * kAcross * kLevels; ++i) {
        const glm::vec3 node{static_cast<float>(i % kAcross) - 7.5F,
                             static_cast<float>(i / kAcross % kAcross) - 7.5F,
                             static_cast<float>(i / (kAcross * kAcross)) - 1.5F};
        const auto key = static_cast<std::uint32_t>(i);
        const glm::vec3 jitter{chance(key, 1U) - 0.5F, chance(key, 2U) - 0.5F, chance(key, 3U) - 0.5F};
        slab.particles.push_back(
            {(node + 0.9F * jitter) * kSpacing, radius, optical_depth / per_depth, CloudShape::kSizes - 1U});
    }
    slab.lit.resize(slab.particles.size());
    return slab;
}

/// pi L / (mu0 E) of light that travels along `way`, the mean over one period of the lattice.
double slab_brf_of(const Column& slab, const Shading& shading, const glm::vec3& way, double mu0) {
    constexpr int kNodes = 4;
    double sum = 0.0;
    std::vector<Shaded> shaded(slab.particles.size());
    Spheres spheres;
    for (int i = 0; i < kNodes * kNodes; ++i) {
        const glm::vec3 target{25.0F * static_cast<float>(i % kNodes), 25.0F * static_cast<float>(i / kNodes),
                               0.0F};
        shade(slab.particles, slab.lit, shading, -way * 2500.0F - target, shaded);
        lay_out(shaded, spheres);
        sum += static_cast<double>(meet(shaded, spheres, -way, {}).v[kSunlight]);
    }
    return std::numbers::pi * sum / (kNodes * kNodes) / mu0;
}

// The report: what each way of handing on light is worth where the truth is known. Rows at albedo 1 with view
// and Sun within 60 degrees of the vertical, where the box is wide enough.
TEST(Shading, IsHeldAgainstTheSlabTruth) {
    const std::string path = SKYIG_REFERENCE "/weather/cloud_slab_truth.csv";
    if (!std::ifstream(path)) GTEST_SKIP() << path << " is not there";
    const auto rows = tests::read_csv(path);
    constexpr std::array<LightMethod, 3> kMethods{LightMethod::kProduct, LightMethod::kGather,
                                                  LightMethod::kDepths};
    constexpr std::array<const char*, 3> kNames{"product", "gather", "depths"};
    std::array<double, 3> medians{};
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
        std::vector<double> errors;
        double made_depth = -1.0;
        double made_zenith = -1.0;
        Column slab;
        for (const auto& row : rows) {
            const std::string quantity = row.text("quantity");
            if (quantity != "R_brf" && quantity != "T_brf") continue;
            if (row.number("single_scattering_albedo") != 1.0 || row.number("sun_zenith_deg") > 61.0 ||
                row.number("view_zenith_deg") > 61.0 || row.number("optical_depth") < 1.5)
                continue;
            const double zenith = row.number("sun_zenith_deg") * std::numbers::pi / 180.0;
            const double depth = row.number("optical_depth");
            const glm::vec3 towards{std::sin(zenith), 0.0, std::cos(zenith)};
            const Shading shading = shading_of(kMethods[m], towards);
            if (depth != made_depth || zenith != made_zenith) {
                slab = slab_of(static_cast<float>(depth));
                light(slab, shading);
                made_depth = depth;
                made_zenith = zenith;
            }
            // Azimuth 0 is where the sunlight goes.
            const double view = row.number("view_zenith_deg") * std::numbers::pi / 180.0;
            const double azimuth = row.number("rel_azimuth_deg") * std::numbers::pi / 180.0;
            const double up = quantity == "R_brf" ? 1.0 : -1.0;
            const glm::vec3 way{-std::sin(view) * std::cos(azimuth), std::sin(view) * std::sin(azimuth),
                                up * std::cos(view)};
            const double value = slab_brf_of(slab, shading, way, std::cos(zenith));
            errors.push_back(std::abs(value - row.number("value")) / std::max(0.02, row.number("value")));
        }
        ASSERT_GT(errors.size(), 50U);
        std::sort(errors.begin(), errors.end());
        medians[m] = errors[errors.size() / 2];
        std::printf("slab, %-7s: median %.2f, 90th percentile %.2f of %zu rows\n", kNames[m], medians[m],
                    errors[errors.size() * 9 / 10], errors.size());
        RecordProperty(kNames[m], std::to_string(medians[m]));
    }
    EXPECT_LT(medians[2], 0.35);
    EXPECT_LT(medians[2], 0.6 * std::min(medians[0], medians[1]));
}

TEST(LightBuffer, CostOfACloud) {
    const CloudShape shape = shape_of({});
    std::vector<Particle> particles(kMostParticles);
    particles.resize(make_particles(shape, 77U, 1.0F, 0.0, particles));
    std::vector<Lit> lit(particles.size());
    LightBuffer buffer;
    for (const LightMethod method : {LightMethod::kProduct, LightMethod::kDepths}) {
        const Shading shading = shading_of(method, glm::normalize(glm::vec3{1.0F, 0.5F, 0.7F}));
        double best_ms = 1e9;
        for (int run = 0; run < 20; ++run) {
            const double begin_ms = cpu_ms();
            for (int i = 0; i < 10; ++i)
                buffer.light(shape, particles, shading, lit);
            best_ms = std::min(best_ms, 0.1 * (cpu_ms() - begin_ms));
        }
        std::printf("one cloud of %zu particles lit from the Sun, above and below: %.3f ms, %s\n",
                    particles.size(), best_ms, kernels().name);
        EXPECT_GT(best_ms, 0.0);
    }
}

}  // namespace
}  // namespace skyig::render::cloud::impostor
