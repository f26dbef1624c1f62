#include "render/eye/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/csv.h"

namespace skyig::render::eye {
namespace {

DisplaySettings display_of(double white_cd_m2) {
    DisplaySettings display;
    display.max_luminance_cd_m2 = white_cd_m2;
    display.adaptation_luminance_cd_m2 = 0.5 * white_cd_m2;
    return display;
}

TEST(ToneCurve, HybridMatchesThePublishedFormulasAtEveryRow) {
    const auto rows = skyig::tests::read_csv(SKYIG_TEST_DATA "/eye/default_operator.csv");
    ASSERT_GT(rows.size(), 40U);
    double worst = 0.0;
    for (const auto& row : rows) {
        // The table prints La with seven digits.
        for (const auto& [white, column] : {std::pair{100.0, "A"}, std::pair{350.0, "B"}}) {
            const ToneCurve curve = tone_curve(display_of(white), row.number("La_cd_m2"));
            worst = std::max({worst, std::abs(curve.p - row.number(std::string("p") + column)),
                              std::abs(curve.q - row.number(std::string("q") + column))});
        }
    }
    std::printf("largest difference of p or q: %.2g\n", worst);
    EXPECT_LT(worst, 3e-6);
}

TEST(ToneCurve, UniformFieldsKeepTheirOrderFromNightToNoon) {
    for (const double white : {100.0, 350.0}) {
        double last = 0.0;
        for (double log_l = -6.0; log_l <= 5.0; log_l += 0.01) {
            const double l = std::pow(10.0, log_l);
            const auto tone = tone_parameters(display_of(white), l);
            const double shown = std::exp2(tone.log2_gain + tone.exponent * std::log2(l));
            EXPECT_GT(shown, last) << "at " << l << " cd/m2 on " << white;
            last = shown;
        }
    }
}

TEST(ToneCurve, PointGainFallsAsTheEyeAdaptsToLight) {
    const DisplaySettings display = display_of(350.0);
    double last = std::numeric_limits<double>::infinity();
    for (double log_l = -4.0; log_l <= 3.5; log_l += 0.25) {
        const double gain = point_gain(display, std::pow(10.0, log_l));
        // Where cones take over from rods a tenth of a magnitude comes back.
        EXPECT_LT(gain, 1.12 * last);
        last = gain;
    }
    EXPECT_GT(point_gain(display, 2e-4), 100.0);
}

TEST(Shown, FloatFollowsDoubleWithinAThousandthOfACode) {
    double worst = 0.0;
    for (double log_a = -5.0; log_a <= 4.5; log_a += 0.5) {
        const auto tone = tone_parameters(display_of(350.0), std::pow(10.0, log_a));
        const auto tone32 = single_precision(tone);
        for (double log_l = -7.0; log_l <= 9.0; log_l += 0.05) {
            const glm::dvec3 rgb = glm::dvec3{0.7, 1.0, 1.6} * std::pow(10.0, log_l);
            const glm::dvec3 exact = shaders64::shown(rgb, tone);
            const glm::dvec3 quick{shaders32::shown(glm::vec3{rgb}, tone32)};
            const glm::dvec3 d = glm::abs(exact - quick) * 255.0;
            worst = std::max({worst, d.x, d.y, d.z});
        }
    }
    std::printf("largest difference: %.2g codes\n", worst);
    EXPECT_LT(worst, 2e-3);
}

TEST(Shown, HardLuminancesGiveCodesBetweenBlackAndWhite) {
    const auto tone = single_precision(tone_parameters(display_of(350.0), 1e-4));
    const float denormal = std::numeric_limits<float>::denorm_min();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3 rgb : {glm::vec3{0.0F}, glm::vec3{denormal}, glm::vec3{1e-6F}, glm::vec3{1e9F},
                                glm::vec3{-1.0F}, glm::vec3{-1.0F, 5.0F, 2.0F}, glm::vec3{nan}}) {
        const glm::vec3 code = shaders32::shown(rgb, tone);
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(code[i], 0.0F);
            EXPECT_LE(code[i], 1.0F);
        }
    }
    EXPECT_GT(shaders32::shown(glm::vec3{1e9F}, tone).x, 0.9999F);
}

TEST(Shown, GamutMappingKeepsLuminance) {
    const glm::dvec3 out_of_gamut{-0.2, 1.0, 0.4};
    const double grey = shaders64::luminance_709(out_of_gamut);
    const glm::dvec3 mapped = shaders64::inside_gamut(out_of_gamut, grey);
    EXPECT_NEAR(shaders64::luminance_709(mapped), grey, 1e-12);
    EXPECT_GE(std::min({mapped.x, mapped.y, mapped.z}), 0.0);
}

TEST(Shown, NightTurnsBlueGreyAndDayKeepsItsColours) {
    const glm::dvec3 red{1.0, 0.0, 0.0};
    const glm::dvec3 night = shaders64::night_coloured(red, 0.0);
    EXPECT_LT(night.x, night.z);
    EXPECT_EQ(shaders64::night_coloured(red, 1.0), red);
    // Grey keeps its luminance: the rods' weights sum to 1 and the tint has luminance 1.
    const glm::dvec3 grey = shaders64::night_coloured(glm::dvec3{1.0}, 0.0);
    EXPECT_NEAR(shaders64::luminance_709(grey), 1.0, 2e-3);
}

TEST(ToneCurve, ByDayBrightPartsAreShownBelowTheShoulder) {
    const DisplaySettings display;
    const auto white_parts = [&](double luminance, double adaptation) {
        return shaders64::display_linear(glm::dvec3{luminance}, tone_parameters(display, adaptation)).y;
    };
    // A dark blue sky over sunlit clouds.
    const double sky = 3700.0;
    const double clouds = 35000.0;
    const double adapted = adaptation_to_bright(display, sky, clouds);
    std::printf("clouds of %.0f cd/m2: adapted to %.0f not %.0f, shown at %.3f of white, not %.2f\n", clouds,
                adapted, sky, white_parts(clouds, adapted), white_parts(clouds, sky));
    EXPECT_GT(white_parts(clouds, sky), 1.5);
    EXPECT_NEAR(white_parts(clouds, adapted), display.shoulder, 1e-3);
    // Nothing happens where there is room, by night, or for an operator without any.
    EXPECT_EQ(adaptation_to_bright(display, 5000.0, 9000.0), 5000.0);
    EXPECT_EQ(adaptation_to_bright(display, 5000.0, 2000.0), 5000.0);
    EXPECT_EQ(adaptation_to_bright(display, 90.0, 4000.0), 90.0);
    DisplaySettings linear;
    linear.tone = ToneOperator::kLinear;
    EXPECT_EQ(adaptation_to_bright(linear, sky, clouds), sky);
    // Brighter parts never lower it, and it moves without a step.
    double last = sky;
    for (double bright = sky; bright < 1e5; bright *= 1.01) {
        const double now = adaptation_to_bright(display, sky, bright);
        EXPECT_GE(now, last);
        EXPECT_LT(now, 1.02 * last);
        last = now;
    }
}

}  // namespace
}  // namespace skyig::render::eye
