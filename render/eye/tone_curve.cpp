#include "render/eye/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/eye/point_threshold.h"

namespace skyig::render::eye {

namespace {

// Tumblin and Rushmeier's exponents for luminances in cd/m2 (0.4 l + 2.92 and -0.4 l^2 - 2.584 l + 2.0208
// with l = log10 of lamberts).
double alpha(double log_l) {
    return 0.4 * log_l + 1.519;
}
double beta(double log_l) {
    return -0.4 * log_l * log_l + 0.218 * log_l + 6.1642;
}

const double kLogLambert = std::log10(std::numbers::pi * 1e-4);

ToneCurve tumblin(double log_world, double log_display) {
    const double alpha_display = alpha(log_display);
    const double q = alpha(log_world) / alpha_display;
    return {(beta(log_world) - beta(log_display)) / alpha_display + (q - 1.0) * kLogLambert, q};
}

// Log10 of the threshold luminance difference (Ferwerda et al. 1996, equations 1 and 2).
double log_threshold_cones(double l) {
    if (l <= -2.6) return -0.72;
    if (l >= 1.9) return l - 1.255;
    return std::pow(0.249 * l + 0.65, 2.7) - 0.72;
}
double log_threshold_rods(double l) {
    if (l <= -3.94) return -2.86;
    if (l >= -1.44) return l - 0.395;
    return std::pow(0.405 * l + 1.6, 2.18) - 2.86;
}

// 0 at 0.01 cd/m2 and below, 1 at 1 cd/m2 and above.
double day_share(double log_world) {
    const double t = std::clamp((log_world + 2.0) / 2.0, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

ToneCurve hybrid(double log_world, double log_display) {
    const double day = day_share(log_world);
    const double most_sensitive = std::min(log_threshold_cones(log_world), log_threshold_rods(log_world));
    const ToneCurve night{log_threshold_cones(log_display) - most_sensitive, 1.0};
    const ToneCurve bright = tumblin(log_world, log_display);
    return {night.p + (bright.p - night.p) * day, night.q + (bright.q - night.q) * day};
}

constexpr double kDarkest_cd_m2 = 1e-6;

}  // namespace

ToneCurve tone_curve(const DisplaySettings& display, double adaptation_cd_m2) noexcept {
    const double log_world = std::log10(std::max(adaptation_cd_m2, kDarkest_cd_m2));
    if (display.tone == ToneOperator::kLinear) {
        return {std::log10(0.18 * display.max_luminance_cd_m2) - log_world, 1.0};
    }
    return hybrid(log_world, std::log10(std::max(display.adaptation_luminance_cd_m2, 0.1)));
}

double highlight_room(double adaptation_cd_m2) noexcept {
    // Chosen by looking at dawn, noon, dusk and 12 km: less burns the horizon out, more dims the zenith.
    // Spread over five decades, so that brighter fields are still shown brighter.
    constexpr double kDayRoom = 0.45;
    const double t =
        std::clamp((std::log10(std::max(adaptation_cd_m2, kDarkest_cd_m2)) + 3.0) / 5.0, 0.0, 1.0);
    return kDayRoom * t * t * (3.0 - 2.0 * t);
}

double point_gain(const DisplaySettings& display, double adaptation_cd_m2) noexcept {
    // Chosen by looking: eyes before a display are not as dark-adapted, nor its codes as fine, as the
    // threshold by night supposes.
    constexpr double kNightAbove = 30.0;
    constexpr double kDayAbove = 4.0;
    const double adaptation = std::max(adaptation_cd_m2, kDarkest_cd_m2);
    const ToneCurve curve = tone_curve(display, adaptation);
    if (display.tone == ToneOperator::kLinear) return std::pow(10.0, curve.p);
    const double log_field = curve.p - highlight_room(adaptation) + curve.q * std::log10(adaptation);
    const double field = std::min(std::pow(10.0, log_field), display.max_luminance_cd_m2);
    const double above = kNightAbove * std::pow(kDayAbove / kNightAbove, shaders64::photopic_share(adaptation));
    return above * threshold_lux(field) / threshold_lux(adaptation);
}

shaders64::ToneParameters tone_parameters(const DisplaySettings& display, double adaptation_cd_m2) noexcept {
    ToneCurve curve = tone_curve(display, adaptation_cd_m2);
    if (display.tone == ToneOperator::kHybrid) curve.p -= highlight_room(adaptation_cd_m2);
    shaders64::ToneParameters tone{};
    tone.log2_gain = curve.p / std::numbers::ln2 * std::numbers::ln10;
    tone.exponent = curve.q;
    tone.photopic = shaders64::photopic_share(adaptation_cd_m2);
    tone.point_gain = point_gain(display, adaptation_cd_m2);
    tone.inv_display_max = 1.0 / display.max_luminance_cd_m2;
    tone.encode_power = display.srgb ? 0.0 : 1.0 / display.gamma;
    return tone;
}

shaders32::ToneParameters single_precision(const shaders64::ToneParameters& tone) noexcept {
    return {static_cast<float>(tone.log2_gain),       static_cast<float>(tone.exponent),
            static_cast<float>(tone.photopic),        static_cast<float>(tone.point_gain),
            static_cast<float>(tone.inv_display_max), static_cast<float>(tone.encode_power)};
}

}  // namespace skyig::render::eye
