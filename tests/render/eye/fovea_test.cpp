#include "render/eye/fovea.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/eye/tone_curve.h"

namespace skyig::render::eye {
namespace {

TEST(Fovea, WhatIsLookedAtIsDimmedAboveTheFramesAdaptationAloneAndKeepsItsOrder) {
    const DisplaySettings display;
    for (const double adaptation : {2e-4, 1e-2, 1.0, 3000.0}) {
        const auto frame = tone_parameters(display, adaptation);
        double last = 0.0;
        for (double log_l = -5.0; log_l < 6.0; log_l += 0.05) {
            const double own = std::pow(10.0, log_l);
            const double shown = looked_at_cd_m2(display, frame, own);
            EXPECT_LE(shown, own);
            EXPECT_GT(shown, last) << adaptation << " " << own;
            if (own <= adaptation) {
                EXPECT_NEAR(shown / own, 1.0, 1e-9) << adaptation << " " << own;
            }
            last = shown;
        }
    }
}

TEST(Fovea, FullMoonStaysOnTheDisplayWithRoomForItsRaysAtEveryAdaptation) {
    const DisplaySettings display;
    for (const double adaptation : {2e-4, 1e-2, 1.0, 50.0}) {
        const auto frame = tone_parameters(display, adaptation);
        const auto eye = fovea(display, frame, 0.4, 4000.0);
        for (const double own : {0.4, 4000.0}) {
            const double seen = own * shaders64::foveal_factor(eye, own);
            const double white = shaders64::display_linear(glm::dvec3{seen}, frame).y;
            std::printf("adapted to %.4g, %.4g cd/m2 is shown at %.2f of white\n", adaptation, own, white);
            EXPECT_LT(white, 0.85);
            if (own > 1000.0) {
                EXPECT_GT(white, 0.5);
            }
        }
    }
}

TEST(Fovea, LinearOperatorMeasuresAndDimsNothing) {
    DisplaySettings display;
    display.tone = ToneOperator::kLinear;
    const auto frame = tone_parameters(display, 1e-3);
    EXPECT_EQ(looked_at_cd_m2(display, frame, 4000.0), 4000.0);
    EXPECT_EQ(shaders64::foveal_factor(fovea(display, frame, 0.4, 4000.0), 4000.0), 1.0);
}

TEST(Fovea, VeilCountsWhereItIsTheStrongerAndTheLightWhereThatIs) {
    const auto light = [](double l, double veil, double share) {
        return shaders64::beside_veil(glm::dvec3{l}, glm::dvec3{veil}, share).y;
    };
    EXPECT_DOUBLE_EQ(light(0.0, 2.0, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(light(3.0, 0.0, 1.0), 3.0);
    EXPECT_NEAR(light(100.0, 10.0, 0.9), 100.0, 0.1);
    EXPECT_NEAR(light(0.01, 10.0, 0.1), 11.0, 0.01) << "a tenth of the light brightens the veil by a tenth";
}

}  // namespace
}  // namespace skyig::render::eye
