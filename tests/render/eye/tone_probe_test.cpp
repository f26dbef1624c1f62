// The operators as the driver computes them, read back: against tables computed in double from the published
// formulas, in order for every adaptation, and whole for whatever comes in.
#include "render/tone_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "render/eye/tone_curve.h"
#include "render/gl/headless_context.h"
#include "tests/csv.h"

namespace skyig::render {
namespace {

constexpr std::array kOperators{ToneOperator::kHybrid,   ToneOperator::kTumblin, ToneOperator::kTumblinSafe,
                                ToneOperator::kReinhard, ToneOperator::kWard,    ToneOperator::kLinear};

const char* name_of(ToneOperator tone) {
    return kToneOperatorNames[static_cast<std::size_t>(tone)].data();
}

// The displays of the tables.
DisplaySettings table_display(ToneOperator tone, double max_cd_m2, double black_cd_m2) {
    DisplaySettings display;
    display.max_luminance_cd_m2 = max_cd_m2;
    display.adaptation_luminance_cd_m2 = 0.5 * max_cd_m2;
    display.black_cd_m2 = 0.5 * black_cd_m2;
    display.reflected_cd_m2 = 0.5 * black_cd_m2;
    display.srgb = false;
    display.tone = tone;
    return eye::operator_alone(display);
}

std::vector<float> decades(double first, double last, double step) {
    std::vector<float> out;
    for (double log_l = first; log_l <= last + 1e-9; log_l += step)
        out.push_back(static_cast<float>(std::pow(10.0, log_l)));
    return out;
}

class ToneProbeTest : public ::testing::Test {
  protected:
    std::vector<ShownGrey> measure(const std::vector<float>& luminance, const DisplaySettings& display,
                                   double adaptation_cd_m2) {
        std::vector<ShownGrey> shown(luminance.size());
        probe_.measure(luminance, eye::single_precision(eye::tone_parameters(display, adaptation_cd_m2)),
                       shown);
        return shown;
    }
    ShownGrey measure(double luminance, const DisplaySettings& display, double adaptation_cd_m2) {
        return measure(std::vector<float>{static_cast<float>(luminance)}, display, adaptation_cd_m2)[0];
    }

    gl::HeadlessContext context_ = gl::HeadlessContext::create(true);
    ToneProbe probe_;
};

TEST_F(ToneProbeTest, TumblinIsThatOfTheTables) {
    const auto rows = skyig::tests::read_csv(SKYIG_TEST_DATA "/eye/tumblin_rushmeier.csv");
    ASSERT_GT(rows.size(), 400U);
    for (const auto& [tone, column] : {std::pair{ToneOperator::kTumblin, std::string("raw")},
                                       std::pair{ToneOperator::kTumblinSafe, std::string("safe")}}) {
        double worst = 0.0;
        int compared = 0;
        for (const auto& row : rows) {
            const double light = row.number("Lw_cd_m2");
            const double adaptation =
                row.text("Lwa_cd_m2") == "self" ? light : std::stod(row.text("Lwa_cd_m2"));
            // Contrast that is turned over is no target.
            if (tone == ToneOperator::kTumblin && adaptation <= eye::kTumblinZero_cd_m2) continue;
            const double a = measure(light, table_display(tone, 100.0, 1.0), adaptation).n;
            const double b = measure(light, table_display(tone, 350.0, 0.35), adaptation).n;
            worst = std::max(
                {worst, std::abs(a - row.number("nA_" + column)), std::abs(b - row.number("nB_" + column))});
            ++compared;
        }
        std::printf("%-12s %d rows, two displays: %.1e of a display value at most\n", name_of(tone), compared,
                    worst);
        EXPECT_GT(compared, 390);
        EXPECT_LT(worst, 1e-4);
    }
}

TEST_F(ToneProbeTest, HybridIsThatOfTheTable) {
    const auto rows = skyig::tests::read_csv(SKYIG_TEST_DATA "/eye/default_operator.csv");
    ASSERT_GT(rows.size(), 40U);
    double worst = 0.0;
    for (const auto& row : rows) {
        const double adaptation = row.number("La_cd_m2");
        for (const auto& [max_cd_m2, column] : {std::pair{100.0, "A"}, std::pair{350.0, "B"}}) {
            const double p = row.number(std::string("p") + column);
            const double q = row.number(std::string("q") + column);
            for (const double ratio : {0.01, 1.0, 10.0}) {
                const double wanted_cd_m2 = std::pow(10.0, p + q * std::log10(adaptation * ratio));
                const double wanted = std::pow(std::min(wanted_cd_m2 / max_cd_m2, 1.0), 1.0 / 2.2);
                const ShownGrey shown = measure(
                    adaptation * ratio, table_display(ToneOperator::kHybrid, max_cd_m2, 0.0), adaptation);
                worst = std::max(worst, std::abs(shown.n - wanted));
                if (ratio == 1.0) {
                    EXPECT_NEAR(shown.display_cd_m2 / row.number(std::string("Ld") + column + "_uniform"),
                                1.0, 1e-4);
                }
            }
        }
    }
    std::printf("hybrid: %.1e of a display value at most\n", worst);
    EXPECT_LT(worst, 1e-4);
}

TEST_F(ToneProbeTest, BrighterLightIsNeverShownDarkerWhateverTheAdaptation) {
    const std::vector<float> light = decades(-7.0, 9.0, 1.0 / 62.0);
    for (const ToneOperator tone : kOperators) {
        for (const bool alone : {true, false}) {
            DisplaySettings display;
            display.tone = tone;
            display.black_cd_m2 = 0.5;
            if (alone) display = eye::operator_alone(display);
            double fall = 0.0;
            for (double log_a = -6.0; log_a <= 5.0; log_a += 0.1) {
                const auto shown = measure(light, display, std::pow(10.0, log_a));
                for (std::size_t i = 1; i < shown.size(); ++i)
                    fall = std::max(fall, shown[i - 1].n - shown[i].n);
            }
            std::printf("%-12s %-16s largest fall of n: %.1e\n", name_of(tone), alone ? "alone" : "as drawn",
                        fall);
            // A hundredth of a code: what single precision may do where a curve is flat.
            EXPECT_LT(fall, 4e-5) << name_of(tone);
        }
    }
}

TEST_F(ToneProbeTest, FieldsOfTheirOwnLuminanceKeepTheirOrder) {
    for (const ToneOperator tone :
         {ToneOperator::kHybrid, ToneOperator::kTumblin, ToneOperator::kTumblinSafe, ToneOperator::kWard}) {
        DisplaySettings display;
        display.tone = tone;
        double last = 0.0;
        for (double log_a = -6.0; log_a <= 5.0; log_a += 0.05) {
            // Below that it has none to keep.
            if (tone == ToneOperator::kTumblin && log_a < std::log10(eye::kTumblinZero_cd_m2)) continue;
            const double field = std::pow(10.0, log_a);
            const double n = measure(field, display, field).n;
            EXPECT_GE(n, last) << name_of(tone) << " at " << field;
            last = n;
        }
    }
}

TEST_F(ToneProbeTest, TheDriverFollowsTheSameTextInDoubleWithinATenthOfACode) {
    const std::vector<float> light = decades(-7.0, 9.0, 0.02);
    for (const ToneOperator tone : kOperators) {
        double worst = 0.0;
        for (const bool srgb : {true, false}) {
            DisplaySettings display;
            display.tone = tone;
            display.srgb = srgb;
            for (double log_a = -6.0; log_a <= 5.0; log_a += 0.5) {
                const double adaptation = std::pow(10.0, log_a);
                const auto exact = eye::tone_parameters(display, adaptation);
                const auto shown = measure(light, display, adaptation);
                for (std::size_t i = 0; i < light.size(); ++i) {
                    const double n = shaders64::shown(glm::dvec3{static_cast<double>(light[i])}, exact).y;
                    worst = std::max(worst, std::abs(shown[i].n - n) * 255.0);
                }
            }
        }
        std::printf("%-12s driver against double: %.1e codes\n", name_of(tone), worst);
        EXPECT_LE(worst, 0.1) << name_of(tone);
    }
}

TEST_F(ToneProbeTest, WhateverComesInIsShownBetweenBlackAndWhite) {
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    const std::vector<float> light{0.0F,
                                   std::numeric_limits<float>::denorm_min(),
                                   1e-30F,
                                   1e30F,
                                   std::numeric_limits<float>::max(),
                                   kInfinite,
                                   -1.0F,
                                   -kInfinite,
                                   std::numeric_limits<float>::quiet_NaN()};
    for (const ToneOperator tone : kOperators) {
        for (const bool alone : {true, false}) {
            DisplaySettings display;
            display.tone = tone;
            if (alone) display = eye::operator_alone(display);
            for (double log_a = -6.0; log_a <= 5.0; log_a += 1.0) {
                const auto shown = measure(light, display, std::pow(10.0, log_a));
                for (std::size_t i = 0; i < light.size(); ++i) {
                    EXPECT_TRUE(shown[i].n >= 0.0 && shown[i].n <= 1.0) << name_of(tone) << " " << light[i];
                    EXPECT_TRUE(std::isfinite(shown[i].display_cd_m2)) << name_of(tone) << " " << light[i];
                }
                EXPECT_EQ(shown[0].n, 0.0);
                EXPECT_EQ(shown[8].n, 0.0);
                // All light is alike to it in the dark.
                if (tone != ToneOperator::kTumblin || log_a > -3.5) {
                    EXPECT_GT(shown[5].n, 0.999) << name_of(tone) << " " << log_a;
                }
            }
        }
    }
}

TEST_F(ToneProbeTest, WhatIsDarkerThanTheScreensBlackIsBlack) {
    DisplaySettings display = table_display(ToneOperator::kLinear, 100.0, 1.0);
    // Linear: the adaptation luminance, 10, is shown as 18 cd/m2.
    EXPECT_EQ(measure(10.0 * 0.999 / 18.0, display, 10.0).n, 0.0);
    EXPECT_NEAR(measure(10.0, display, 10.0).n, std::pow(0.17, 1.0 / 2.2), 1e-4);
    EXPECT_NEAR(measure(10.0 * 101.0 / 18.0, display, 10.0).n, 1.0, 1e-4);
    display.srgb = true;
    EXPECT_NEAR(measure(10.0, display, 10.0).n, 1.055 * std::pow(0.17, 1.0 / 2.4) - 0.055, 1e-4);
}

}  // namespace
}  // namespace skyig::render
