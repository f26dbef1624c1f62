// A day at sixty times its pace: the evening of it, for higher up and further down next to nothing changes.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/render/gl_fixture.h"
#include "tests/render/steadiness.h"

namespace skyig::render {
namespace {

using namespace tests;

class FastDay : public GlTest {};

TEST_F(FastDay, PlaysWithoutAVisibleJumpOfBrightness) {
    Flight evening{"24 degrees to 24 below"};
    evening.sun_deg = 24.0;
    evening.sun_deg_per_s = -15.0 / 60.0;
    evening.climb_m_s = 0.0;
    double brightness = 0.0;
    // Each part begins anew where the one before has ended, a frame earlier.
    for (int first = 0; first < 5760; first += 1440) {
        const Steps steps = largest_step(evening, first, 1441);
        std::printf("Sun from %5.1f deg: brightness of a channel %.2f codes a frame at most, a pixel %d\n",
                    24.0 - first / 120.0, steps.brightness, steps.largest);
        brightness = std::max(brightness, steps.brightness);
        // Beside a setting Sun the glow itself sets by up to 2.5 codes a frame.
        EXPECT_LE(steps.largest, 3);
    }
    EXPECT_LE(brightness, 1.0);
}

}  // namespace
}  // namespace skyig::render
