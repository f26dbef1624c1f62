#include "render/eye/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/eye/point_threshold.h"
#include "render/eye/tone_curve.h"

namespace skyig::render::eye {
namespace {

TEST(Exposure, HalfFloatsPutTheAdaptationLuminanceWhereBothEndsFit) {
    for (double log_a = -6.0; log_a <= 9.0; log_a += 0.01) {
        const double adaptation = std::pow(10.0, log_a);
        const int k = exposure_exponent(Target::kHalfLuminance, adaptation);
        const double stored = std::ldexp(adaptation, k);
        EXPECT_GE(stored, std::ldexp(1.0, -9) * (1.0 - 1e-12));
        EXPECT_LT(stored, std::ldexp(1.0, -8));
    }
    for (const double odd : {0.0, -1.0, std::numeric_limits<double>::infinity()})
        EXPECT_LT(std::abs(exposure_exponent(Target::kHalfLuminance, odd)), 60);
}

TEST(Exposure, StoresLightAsItIsAndEndsAtTheLargestHalfFloat) {
    const auto tone = luminance_parameters(-20);
    const glm::dvec3 outside{-0.3, 2e9, 1e-6};
    const glm::dvec3 stored = shaders64::shown(outside, tone);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(stored[i], std::ldexp(outside[i], -20));
    EXPECT_EQ(shaders64::shown(glm::dvec3{1e12}, tone).x, 65504.0);
    EXPECT_EQ(tone.point_gain * tone.inv_display_max, std::ldexp(1.0, -20));
}

TEST(PointThreshold, IsHeldByTheDisplayThirtyfoldByNightAndFourfoldByDay) {
    for (const double white : {100.0, 350.0}) {
        DisplaySettings display;
        display.max_luminance_cd_m2 = white;
        display.adaptation_luminance_cd_m2 = 0.5 * white;
        for (const auto& [adaptation, above] : {std::pair{2e-4, 30.0}, std::pair{100.0, 4.0}}) {
            const auto tone = tone_parameters(display, adaptation);
            const double field = std::exp2(tone.log2_gain + tone.exponent * std::log2(adaptation));
            const double shown_lux = threshold_lux(adaptation) * point_gain(display, adaptation);
            EXPECT_NEAR(shown_lux / threshold_lux(field), above, 0.01 * above) << white << " " << adaptation;
        }
    }
}

}  // namespace
}  // namespace skyig::render::eye
