#include "render/eye/fovea.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/eye/tone_curve.h"

namespace skyig::render::eye {

namespace {

// Of the highlights' room, for the bright parts of what is looked at: chosen by looking at the full Moon.
constexpr double kRoomKept = 0.3;

// Of a frame's curve: kTumblin has none left in the darkest nights.
constexpr double kLeastContrast = 0.05;

double room_of(const DisplaySettings& display) {
    return display.tone == ToneOperator::kHybrid ? display.highlight_room : 0.0;
}

// Operators that show the scene as one adaptation has it, compressed or not.
bool measures(const DisplaySettings& display) {
    return display.tone == ToneOperator::kLinear || display.tone == ToneOperator::kReinhard;
}

// log2 of the factor, before it is kept at 1.
double log2_factor(const DisplaySettings& display, const shaders64::ToneParameters& frame, double own_cd_m2,
                   double room) {
    const ToneCurve own = tone_curve(display, own_cd_m2);
    const double log_own = std::log10(own_cd_m2);
    const double log2_shown = (own.p - room + own.q * log_own) * std::numbers::ln10 / std::numbers::ln2;
    return (log2_shown - frame.log2_gain) / std::max(frame.exponent, kLeastContrast) - std::log2(own_cd_m2);
}

}  // namespace

double looked_at_cd_m2(const DisplaySettings& display, const shaders64::ToneParameters& frame,
                       double own_cd_m2) noexcept {
    if (measures(display) || !(own_cd_m2 > 0.0)) return own_cd_m2;
    return own_cd_m2 * std::exp2(std::min(0.0, log2_factor(display, frame, own_cd_m2,
                                                           highlight_room(room_of(display), own_cd_m2))));
}

shaders64::Fovea fovea(const DisplaySettings& display, const shaders64::ToneParameters& frame,
                       double low_cd_m2, double high_cd_m2) noexcept {
    shaders64::Fovea result{};
    if (measures(display)) return result;
    const double low =
        log2_factor(display, frame, low_cd_m2, kRoomKept * highlight_room(room_of(display), low_cd_m2));
    const double high =
        log2_factor(display, frame, high_cd_m2, kRoomKept * highlight_room(room_of(display), high_cd_m2));
    result.slope = (high - low) / std::log2(high_cd_m2 / low_cd_m2);
    result.log2_factor = high - result.slope * std::log2(high_cd_m2);
    return result;
}

}  // namespace skyig::render::eye
