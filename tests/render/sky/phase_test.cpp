#include "render/sky/phase.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "render/sky/quadrature.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

// Mean of f * phase over the sphere.
template <class Function>
double over_sphere(Function&& function) {
    const auto rule = gauss_legendre<96>();
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.node.size(); ++i)
        sum += rule.weight[i] * function(rule.node[i]);
    return 2.0 * std::numbers::pi * sum;
}

TEST(Quadrature, IntegratesPolynomialsExactly) {
    const auto rule = gauss_legendre<8>();
    for (int power = 0; power <= 15; ++power) {
        double sum = 0.0;
        for (std::size_t i = 0; i < rule.node.size(); ++i)
            sum += rule.weight[i] * std::pow(rule.node[i], power);
        EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-14) << power;
    }
}

TEST(Phase, RayleighIntegratesToOne) {
    EXPECT_NEAR(over_sphere([](double c) { return rayleigh_phase(c); }), 1.0, 1e-14);
}

TEST(Phase, CornetteShanksIntegratesToOneWithItsMeanCosine) {
    for (const double g : {0.0, 0.5, 0.7, 0.75, 0.8}) {
        const double whole = over_sphere([&](double c) { return cornette_shanks_phase(g, c); });
        const double mean = over_sphere([&](double c) { return c * cornette_shanks_phase(g, c); });
        std::printf("g %.2f: integral - 1 = %.1e, mean cosine error %.1e\n", g, whole - 1.0,
                    mean - cornette_shanks_mean_cosine(g));
        EXPECT_NEAR(whole, 1.0, 1e-9);
        EXPECT_NEAR(mean, cornette_shanks_mean_cosine(g), 1e-9);
    }
}

TEST(Phase, FloatFollowsDoubleInTheAureole) {
    double worst = 0.0;
    for (const double angle : steps(0.0, 3.1416, 1e-3)) {
        const double exact = cornette_shanks_phase(0.8, std::cos(angle));
        const double single = cornette_shanks_phase(0.8F, std::cos(static_cast<float>(angle)));
        worst = std::max(worst, std::abs(single / exact - 1.0));
    }
    std::printf("largest relative error %.1e\n", worst);
    EXPECT_LT(worst, 1e-5);
}

}  // namespace
}  // namespace skyig::render::sky
