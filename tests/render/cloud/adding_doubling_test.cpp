// The solver behind the tables: published and exact values, and that the tables are still what it says.
#include "render/cloud/reference/adding_doubling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "render/cloud/slab_light.h"

namespace skyig::render::cloud::reference {
namespace {

TEST(AddingDoubling, GivesVanDeHulstsPublishedCase) {
    constexpr std::array<double, 1> kOverhead{1.0};
    const AddingDoubling solver({0.75, 0.9}, 0, 20, kOverhead);
    const Layer layer = solver.layer(2.0);
    const std::size_t sun = solver.first_asked();
    // van de Hulst 1980, table 35.
    EXPECT_NEAR(solver.flux(layer.reflected, sun), 0.09739, 1e-5);
    EXPECT_NEAR(solver.flux(layer.transmitted, sun) + layer.direct[sun], 0.66096, 1e-5);
}

TEST(AddingDoubling, LosesNoEnergyWithoutAbsorption) {
    constexpr std::array<double, 2> kSuns{1.0, 0.2};
    const AddingDoubling solver({0.85, 1.0}, 0, 20, kSuns);
    const Layer layer = solver.layer(16.0);
    for (std::size_t sun = solver.first_asked(); sun < solver.mu().size(); ++sun) {
        EXPECT_NEAR(
            solver.flux(layer.reflected, sun) + solver.flux(layer.transmitted, sun) + layer.direct[sun], 1.0,
            1e-5);
    }
}

TEST(AddingDoubling, TheTablesLightIsItsOwn) {
    constexpr std::array<double, 2> kMu{0.9, 0.6};
    constexpr double kDepth = 5.0;
    constexpr double kHalfPi = std::numbers::pi / 2.0;
    // At azimuth 90 deg odd modes vanish; those beyond 4 are less than the bound.
    std::array<double, 2> light{};
    for (const int mode : {0, 2, 4}) {
        const AddingDoubling solver({0.85, 1.0}, mode, 16, kMu);
        const Layer layer = solver.layer(kDepth);
        const std::size_t sun = solver.first_asked();
        const double factor = (mode == 0 ? 1.0 : 2.0) * std::cos(mode * kHalfPi);
        light[0] += factor * layer.reflected(sun + 1, sun);
        light[1] += factor * layer.transmitted(sun + 1, sun);
    }
    const Slab64 slab{kDepth, 0.85, 1.0};
    EXPECT_NEAR(slab_brf(SlabModel::kTable, slab, true, kMu[0], kMu[1], -kMu[0] * kMu[1]) / light[0], 1.0,
                0.04);
    EXPECT_NEAR(slab_brf(SlabModel::kTable, slab, false, kMu[0], kMu[1], kMu[0] * kMu[1]) / light[1], 1.0,
                0.04);
}

}  // namespace
}  // namespace skyig::render::cloud::reference
