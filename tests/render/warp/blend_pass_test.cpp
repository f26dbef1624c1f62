// Blending is done in linear light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/warp/blend.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 256;
constexpr int kHeight = 128;

double decoded(int code, double gamma) {
    const double v = code / 255.0;
    if (gamma > 0.0) return std::pow(v, gamma);
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// A ramp over the left half of the screen; the other projector has what is left.
std::shared_ptr<const warp::Blend> ramp(bool falls) {
    auto blend = std::make_shared<warp::Blend>(warp::Blend{kWidth, kHeight, {}});
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const double rising = std::min(1.0, (i % kWidth + 0.5) / (kWidth / 2.0));
        blend->weight.push_back(static_cast<float>(falls ? 1.0 - rising : rising));
    }
    return blend;
}

class BlendedPicture : public GlTest {
  protected:
    /// The same view through each of them.
    std::vector<Picture> blended(const std::vector<std::shared_ptr<const warp::Blend>>& blends,
                                 const DisplaySettings& display) {
        Scene scene = make_scene(20.0, 60.0, -30.0, 300.0, 400.0);
        std::vector<Channel> channels;
        for (const auto& blend : blends) {
            channels.push_back({.name = "one", .width_px = kWidth, .height_px = kHeight, .blend = blend});
            add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(120.0, 3.0, 5.0));
        }
        return draw(channels, scene, display);
    }
};

TEST_F(BlendedPicture, TwoProjectorsTogetherGiveTheLightOfOne) {
    for (const double gamma : {0.0, 2.2}) {
        DisplaySettings display = undithered();
        display.srgb = gamma == 0.0;
        display.gamma = gamma;
        const auto pictures = blended({nullptr, ramp(false), ramp(true)}, display);
        const Picture &whole = pictures[0], &one = pictures[1], &other = pictures[2];
        double worst = 0.0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double light = decoded(whole.at(x, y).g, gamma);
                const double sum = decoded(one.at(x, y).g, gamma) + decoded(other.at(x, y).g, gamma);
                // By the light that one code more would be.
                const double code = decoded(whole.at(x, y).g + 1, gamma) - light;
                worst = std::max(worst, std::abs(sum - light) / code);
            }
        }
        std::printf("gamma %.1f: the sum is off by %.2f codes\n", gamma, worst);
        EXPECT_LT(worst, 1.05);  // each has been rounded to half a code
    }
}

TEST_F(BlendedPicture, ChangesNothingWhereTheMaskIsOne) {
    const auto pictures = blended({nullptr, ramp(false)}, {});
    const Picture &whole = pictures[0], &one = pictures[1];
    for (int y = 0; y < kHeight; ++y) {
        for (int x = kWidth / 2; x < kWidth; ++x)
            ASSERT_EQ(difference(whole.at(x, y), one.at(x, y)), 0) << x << " " << y;
    }
    EXPECT_LT(one.at(0, 0).g, whole.at(0, 0).g);
}

TEST_F(BlendedPicture, LiftRaisesBlackInLinearLightAndKeepsWhite) {
    auto blend = std::make_shared<warp::Blend>(
        warp::Blend{kWidth, kHeight, std::vector<float>(std::size_t{kWidth} * kHeight, 1.0F), {0.01F}});
    const auto pictures = blended({nullptr, blend}, undithered());
    const Picture &whole = pictures[0], &lifted = pictures[1];
    double worst = 0.0;
    for (int y = 0; y < kHeight; y += 3) {
        for (int x = 0; x < kWidth; x += 3) {
            const double wanted = decoded(whole.at(x, y).b, 0.0) * 0.99 + 0.01;
            const double code = decoded(lifted.at(x, y).b + 1, 0.0) - decoded(lifted.at(x, y).b, 0.0);
            worst = std::max(worst, std::abs(decoded(lifted.at(x, y).b, 0.0) - wanted) / code);
        }
    }
    EXPECT_LT(worst, 0.6);
}

}  // namespace
}  // namespace skyig::render
