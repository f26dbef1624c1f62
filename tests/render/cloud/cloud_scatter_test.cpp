// What a marcher gets: the slab's light in slabs, sensible light in clouds of other shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/cloud/slab_light.h"

namespace skyig::render::cloud {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// As class CloudScatter says, with even steps along the ray.
float marched(float depth, float mu0, float mu_view, float cos_scatter, int steps) {
    const CloudScatter scatter(mu0);
    const CloudScatter::Ray ray = scatter.ray(mu_view, cos_scatter);
    const float step = depth / std::abs(mu_view) / static_cast<float>(steps);
    float light = 0.0F;
    float seen = 1.0F;
    for (int i = 0; i < steps; ++i) {
        const float from_eye = (static_cast<float>(i) + 0.5F) / static_cast<float>(steps) * depth;
        const float above = mu_view > 0.0F ? from_eye : depth - from_eye;
        const float opacity = -std::expm1(-step);
        light += seen * opacity * ray.source({above / mu0, above, depth - above});
        seen *= 1.0F - opacity;
    }
    return light * kPi / mu0;
}

TEST(CloudScatter, EvenStepsThroughASlabGiveTheSlabsLight) {
    for (const float depth : {1.0F, 4.0F, 16.0F}) {
        for (const float mu_view : {0.9F, 0.5F, -0.5F, -0.9F}) {
            const float mu0 = 0.7F;
            const float scatter = -mu0 * mu_view;
            const float exact = slab_brf(SlabModel::kTable, {depth, 0.85F, 1.0F}, mu_view > 0.0F, mu0,
                                         std::abs(mu_view), scatter);
            EXPECT_NEAR(marched(depth, mu0, mu_view, scatter, 32) / exact, 1.0F, 0.1F)
                << "depth " << depth << " view " << mu_view;
        }
    }
}

TEST(CloudScatter, ASunBelowLightsCloudsFromBelowLikeOneAboveFromAbove) {
    const CloudScatter high(0.3F);
    const CloudScatter low(-0.3F);
    EXPECT_FLOAT_EQ(high.ray(0.6F, 0.2F).source({10.0F, 3.0F, 5.0F}),
                    low.ray(-0.6F, 0.2F).source({10.0F, 5.0F, 3.0F}));
}

TEST(CloudScatter, AFlankTurnedToALowSunIsAsWhiteAsATopUnderAHighOne) {
    // Sun 6 deg high; a point one optical depth inside a tall cloud's flank, half of it above.
    const float mu0 = 0.1F;
    const CloudScatter low(mu0);
    const float flank = low.ray(0.0F, -0.99F).source({1.0F, 20.0F, 20.0F});
    const float layer = low.ray(0.0F, -0.99F).source({1.0F, 0.1F, 39.9F});
    const CloudScatter high(1.0F);
    const float top = high.ray(0.9F, -0.9F).source({1.0F, 1.0F, 39.0F});
    EXPECT_GT(flank, 0.5F * top);
    EXPECT_GT(flank, 3.0F * layer);
}

TEST(CloudScatter, DeepInCloudAndInShadowItIsDarkAndFinite) {
    const CloudScatter scatter(0.5F);
    const CloudScatter::Ray ray = scatter.ray(-0.5F, 0.5F);
    const float lit = ray.source({1.0F, 0.5F, 30.0F});
    const float deep = ray.source({60.0F, 30.0F, 0.5F});
    EXPECT_LT(deep, 0.3F * lit);
    EXPECT_GT(deep, 0.0F);
    // Shadow of another cloud falls on it.
    EXPECT_LT(ray.source({400.0F, 0.5F, 30.0F}), 0.5F * lit);
    for (const float depth : {0.0F, 1e-8F, 1e4F}) {
        for (const float mu0 : {0.0F, 1e-6F, 1.0F, -1.0F}) {
            for (const float mu : {-1.0F, 0.0F, 1.0F}) {
                const CloudScatter any(mu0);
                const float value = any.ray(mu, 1.0F).source({depth, depth, depth});
                EXPECT_TRUE(std::isfinite(value) && value >= 0.0F) << depth << ' ' << mu0 << ' ' << mu;
            }
        }
    }
}

TEST(CloudScatter, EvenLightFromBothSidesStaysEven) {
    const CloudScatter scatter;
    for (const float above : {0.0F, 1.0F, 50.0F}) {
        const CloudAmbient ambient = scatter.ambient({0.0F, above, 7.0F});
        EXPECT_FLOAT_EQ(ambient.from_above + ambient.from_below, 1.0F);
        EXPECT_GE(ambient.from_below, 0.0F);
    }
    // Under thick cloud a point sees little of the sky: the flux rows' T of even light, 1 / (1 + 0.75 t).
    const CloudAmbient base = scatter.ambient({0.0F, 30.0F, 0.0F});
    EXPECT_NEAR(base.from_above, 0.5F / (1.0F + 0.75F * 4.5F), 1e-3F);
}

TEST(CloudScatter, ChangesSmoothlyFromPointToPoint) {
    const CloudScatter scatter(0.4F);
    const CloudScatter::Ray ray = scatter.ray(0.3F, 0.1F);
    float last = ray.source({0.0F, 0.0F, 20.0F});
    for (int i = 1; i <= 1950; ++i) {
        const float above = 0.01F * static_cast<float>(i);
        const float now = ray.source({above / 0.4F, above, 20.0F - above});
        ASSERT_LT(std::abs(now - last), 0.04F * std::max(now, last) + 1e-5F) << above;
        last = now;
    }
}

}  // namespace
}  // namespace skyig::render::cloud
