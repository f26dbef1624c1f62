// How world luminance becomes display luminance for one state of adaptation: log10 Ld = p + q log10 L, cd/m2.
#pragma once

#include "render/display.h"
#include "render/shaders/shared.h"

namespace skyig::render::eye {

struct ToneCurve {
    double p = 0.0;
    double q = 1.0;
};

/// \param adaptation_cd_m2  what the eyes in the world are adapted to, > 0 (values below 1e-6 count as 1e-6)
/// kHybrid: Tumblin and Rushmeier (1993) at 1 cd/m2 and above; at 0.01 and below the ratio of the thresholds
/// of Ferwerda et al. (1996), q = 1; p and q blended between. kLinear: the adaptation luminance is shown at
/// 18 % of white.
[[nodiscard]] ToneCurve tone_curve(const DisplaySettings& display, double adaptation_cd_m2) noexcept;

/// Gain of point sources, display cd/m2 per world cd/m2: what makes a star at the threshold before the scene's
/// adaptation luminance stand 30 times by night, by day 4 times above the threshold before that luminance as it
/// is displayed (threshold_lux() of both). kLinear: that of the field.
[[nodiscard]] double point_gain(const DisplaySettings& display, double adaptation_cd_m2) noexcept;

/// log10 of the room that is left on the display for what is brighter than the log-average of the scene: by
/// day the average is shown this much darker than a uniform field would be; at 0.01 cd/m2 and below there is
/// none, thresholds match.
[[nodiscard]] double highlight_room(double adaptation_cd_m2) noexcept;

/// All that the shaders need, in the precision of the GPU and in double: tone_curve() less highlight_room().
[[nodiscard]] shaders64::ToneParameters tone_parameters(const DisplaySettings& display,
                                                        double adaptation_cd_m2) noexcept;
[[nodiscard]] shaders32::ToneParameters single_precision(const shaders64::ToneParameters& tone) noexcept;

}  // namespace skyig::render::eye
