// Every variant that this processor runs must draw the same, and the same as the plain formulas.
#include "render/cloud/impostor/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/cloud/impostor/noise.h"

namespace skyig::render::cloud::impostor {
namespace {

std::vector<const Kernels*> variants() {
    std::vector<const Kernels*> found = {&portable::kernels()};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back(&avx2::kernels());
#endif
    return found;
}

TEST(ImpostorKernels, DimLikeTheFormulaToTheLastBit) {
    std::array<std::uint16_t, kStampSide * kStampSide> mask{};
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask[i] = static_cast<std::uint16_t>(hashed(static_cast<std::uint32_t>(i)));
    const Stamp stamp{mask.data(), 40000, 9000};
    for (const Kernels* kernel : variants()) {
        std::vector<std::uint16_t> light(40 * 40, 50000);
        kernel->dim(light.data() + 3 * 40 + 5, 40, stamp);
        for (int y = 0; y < kStampSide; ++y) {
            for (int x = 0; x < kStampSide; ++x) {
                const std::uint32_t part = mask[static_cast<std::size_t>(y * kStampSide + x)];
                const std::uint32_t truth =
                    50000U - ((50000U * ((part * 40000U) >> 16U)) >> 16U) + ((part * 9000U) >> 16U);
                ASSERT_EQ(light[static_cast<std::size_t>((y + 3) * 40 + x + 5)], truth) << kernel->name;
            }
        }
        EXPECT_EQ(light[0], 50000);
    }
}

TEST(ImpostorKernels, SplatLikeTheFormulaAndStayInsideThePicture) {
    constexpr int kWidth = 48;
    constexpr int kHeight = 32;
    Disc disc{};
    disc.colour = {{0.3F, 0.1F, 0.5F, 0.6F, 1.0F, -40.0F, 0.0F, 0.0F}};
    for (const Kernels* kernel : variants()) {
        for (int i = 0; i < 200; ++i) {
            const auto n = static_cast<std::uint32_t>(i);
            disc.centre_x = chance(n, 1U) * 80.0F - 16.0F;
            disc.centre_y = chance(n, 2U) * 60.0F - 14.0F;
            disc.radius = 0.8F + 20.0F * chance(n, 3U);
            disc.optical_depth = 200.0F * chance(n, 4U) * chance(n, 5U);
            // One row and column more, which must stay as they are.
            std::vector<Texel> picture(kWidth * kHeight + kWidth, Texel{{0.2F, 0.2F, 0.2F, 0.2F, 0.5F}});
            kernel->splat(disc, picture.data(), kWidth, kHeight);
            for (int y = 0; y <= kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    const double dx =
                        (x + 0.5 - static_cast<double>(disc.centre_x)) / static_cast<double>(disc.radius);
                    const double dy =
                        (y + 0.5 - static_cast<double>(disc.centre_y)) / static_cast<double>(disc.radius);
                    const double q = std::max(0.0, 1.0 - dx * dx - dy * dy);
                    const double opacity =
                        y < kHeight ? -std::expm1(-static_cast<double>(disc.optical_depth) * std::pow(q, 2.5))
                                    : 0.0;
                    const Texel& texel = picture[static_cast<std::size_t>(y * kWidth + x)];
                    ASSERT_NEAR(texel.v[kOpacity], 0.5 + 0.5 * opacity, 2e-5) << kernel->name;
                    ASSERT_NEAR(texel.v[kSunlight], 0.2 + 0.1 * opacity, 2e-5) << kernel->name;
                }
            }
        }
        disc.centre_x = 1e9F;
        disc.radius = 1e12F;
        std::vector<Texel> picture(kWidth * kHeight);
        kernel->splat(disc, picture.data(), kWidth, kHeight);
        EXPECT_GT(picture.front().v[kOpacity], 0.9F) << kernel->name;
    }
}

TEST(ImpostorKernels, FindTheSameSpheres) {
    constexpr int kCount = 4 * kBatch;
    std::array<std::vector<float>, 4> table;
    for (std::uint32_t axis = 0; axis < 4; ++axis) {
        for (std::uint32_t i = 0; i < kCount; ++i)
            table[axis].push_back(100.0F * (chance(i, axis) - 0.5F));
    }
    const SphereTable spheres{table[0].data(), table[1].data(), table[2].data(), table[3].data(), 4};
    const std::array<float, 3> ray{0.6F, 0.0F, 0.8F};
    for (const Kernels* kernel : variants()) {
        std::array<float, kCount> half2{};
        std::array<float, 4> any{};
        kernel->halves(spheres, ray.data(), half2.data(), any.data());
        for (std::size_t i = 0; i < kCount; ++i) {
            const float along = 0.6F * table[0][i] + 0.8F * table[2][i];
            EXPECT_NEAR(half2[i], along * along - table[3][i], 1e-3F) << kernel->name;
        }
        for (std::size_t batch = 0; batch < any.size(); ++batch) {
            const auto first = half2.begin() + static_cast<std::ptrdiff_t>(batch * kBatch);
            EXPECT_EQ(any[batch], *std::max_element(first, first + kBatch)) << kernel->name;
        }
    }
}

TEST(ImpostorKernels, FetchBetweenFourTexels) {
    std::array<Texel, 4> texels{Texel{{1.0F, 0.0F}}, Texel{{2.0F, 4.0F}}, Texel{{5.0F, 8.0F}},
                                Texel{{9.0F, 0.0F}}};
    for (const Kernels* kernel : variants()) {
        Texel sum{{1.0F, 1.0F}};
        kernel->add(texels.data(), 2, 0.25F, 0.5F, 2.0F, sum);
        EXPECT_FLOAT_EQ(sum.v[0], 1.0F + 2.0F * 0.5F * (1.25F + 6.0F)) << kernel->name;
        EXPECT_FLOAT_EQ(sum.v[1], 1.0F + 2.0F * 0.5F * (1.0F + 6.0F)) << kernel->name;
    }
}

}  // namespace
}  // namespace skyig::render::cloud::impostor
