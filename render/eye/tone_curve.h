// How world luminance becomes display luminance for one state of adaptation.
#pragma once

#include "render/display.h"
#include "render/shaders/shared.h"

namespace skyig::render::eye {

/// log10 Ld = p + q log10 L, cd/m2.
struct ToneCurve {
    double p = 0.0;
    double q = 1.0;
};

/// tumblin has no contrast left at this adaptation luminance, cd/m2, and would turn it over below.
inline constexpr double kTumblinZero_cd_m2 = 1.5940429e-4;

/// \param adaptation_cd_m2  what the eyes in the world are adapted to, > 0 (values below 1e-6 count as 1e-6)
/// - kTumblin: Tumblin and Rushmeier (1993); below kTumblinZero_cd_m2 as there, where all light is shown
/// alike.
/// - kTumblinSafe: the same with the world's adaptation raised by 1e-3 cd/m2, so that contrast is left by
/// night.
/// - kHybrid: kTumblin at 1 cd/m2 and above; at 0.01 and below the ratio of the thresholds of Ferwerda et al.
///   (1996), q = 1; p and q blended between.
/// - kWard: Ward (1994), thresholds match, q = 1.
/// - kLinear: the adaptation luminance is shown at 18 % of white, q = 1.
/// - kReinhard: as kLinear; what tone_parameters() adds compresses it.
[[nodiscard]] ToneCurve tone_curve(const DisplaySettings& display, double adaptation_cd_m2) noexcept;

/// Gain of point sources, display cd/m2 per world cd/m2: what makes a star at the threshold before the
/// scene's adaptation luminance stand 30 times by night, by day 4 times above the threshold before that
/// luminance as it is displayed (threshold_lux() of both). kLinear, kReinhard: the field's.
[[nodiscard]] double point_gain(const DisplaySettings& display, double adaptation_cd_m2) noexcept;

/// log10 of the room that kHybrid leaves on the display for what is brighter than the log-average of the
/// scene: `day_room` by day, none at 1e-3 cd/m2 and below, where thresholds match.
[[nodiscard]] double highlight_room(double day_room, double adaptation_cd_m2) noexcept;

/// kHybrid: the adaptation at which, by day, what is so bright is shown no brighter than where the screen's
/// shoulder begins: eyes over sunlit clouds adapt to those and not to the dark sky beside them.
/// Between `adaptation_cd_m2`, where no more is needed or below 100 cd/m2, and `bright_cd_m2`.
[[nodiscard]] double adaptation_to_bright(const DisplaySettings& display, double adaptation_cd_m2,
                                          double bright_cd_m2) noexcept;

/// All that the shaders need: the operator, less highlight_room(), and the screen.
[[nodiscard]] shaders64::ToneParameters tone_parameters(const DisplaySettings& display,
                                                        double adaptation_cd_m2) noexcept;
[[nodiscard]] shaders32::ToneParameters single_precision(const shaders64::ToneParameters& tone) noexcept;

/// The settings with nothing left but operator and screen: no room, no shoulder, no night colours. What the
/// truth tables hold.
[[nodiscard]] DisplaySettings operator_alone(DisplaySettings display) noexcept;

}  // namespace skyig::render::eye
