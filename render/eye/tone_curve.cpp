#include "render/eye/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/eye/point_threshold.h"
#include "render/eye/thresholds.h"

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

constexpr double kDarkest_cd_m2 = 1e-6;
constexpr double kDimmestScreen_cd_m2 = 0.1;

// Of Reinhard et al. (2002): what the log-average is shown as, and what is shown as white, in parts of white
// before it is compressed.
constexpr double kKey = 0.18;
constexpr double kReinhardWhite = 4.0;

double log_of(double adaptation_cd_m2) {
    return std::log10(std::max(adaptation_cd_m2, kDarkest_cd_m2));
}

ToneCurve tumblin(double log_world, double log_display) {
    const double alpha_display = alpha(log_display);
    const double q = std::max(alpha(log_world), 0.0) / alpha_display;
    return {(beta(log_world) - beta(log_display)) / alpha_display + (q - 1.0) * kLogLambert, q};
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

// Ward (1994): a threshold difference in the world is one on the screen.
double ward_gain(const Screen& screen, double adaptation_cd_m2) {
    const double display_term = 1.219 + std::pow(0.5 * screen.max_luminance_cd_m2, 0.4);
    return std::pow(display_term / (1.219 + std::pow(adaptation_cd_m2, 0.4)), 2.5);
}

}  // namespace

ToneCurve tone_curve(const DisplaySettings& display, double adaptation_cd_m2) noexcept {
    const double log_world = log_of(adaptation_cd_m2);
    const double log_display = std::log10(std::max(display.adaptation_luminance_cd_m2, kDimmestScreen_cd_m2));
    switch (display.tone) {
        case ToneOperator::kTumblin:
            return tumblin(std::max(log_world, std::log10(kTumblinZero_cd_m2)), log_display);
        case ToneOperator::kTumblinSafe:
            return tumblin(std::log10(std::pow(10.0, log_world) + 1e-3), log_display);
        case ToneOperator::kWard:
            return {std::log10(ward_gain(display, std::pow(10.0, log_world))), 1.0};
        case ToneOperator::kReinhard:
        case ToneOperator::kLinear:
            return {std::log10(kKey * display.max_luminance_cd_m2) - log_world, 1.0};
        case ToneOperator::kHybrid:
            break;
    }
    return hybrid(log_world, log_display);
}

double highlight_room(double day_room, double adaptation_cd_m2) noexcept {
    // Spread over five decades, so that brighter fields are still shown brighter.
    const double t = std::clamp((log_of(adaptation_cd_m2) + 3.0) / 5.0, 0.0, 1.0);
    return day_room * t * t * (3.0 - 2.0 * t);
}

double adaptation_to_bright(const DisplaySettings& display, double adaptation_cd_m2,
                            double bright_cd_m2) noexcept {
    if (display.tone != ToneOperator::kHybrid || !(bright_cd_m2 > adaptation_cd_m2)) return adaptation_cd_m2;
    const double log_bright = std::log10(bright_cd_m2);
    const double log_shoulder = std::log10(display.shoulder * display.max_luminance_cd_m2);
    const auto too_bright = [&](double log_adaptation) {
        const double adaptation = std::pow(10.0, log_adaptation);
        const ToneCurve curve = tone_curve(display, adaptation);
        return curve.p - highlight_room(display.highlight_room, adaptation) + curve.q * log_bright >
               log_shoulder;
    };
    const double log_wanted = log_of(adaptation_cd_m2);
    double low = log_wanted;
    double high = log_bright;
    // A twilight's arch may be brighter than the screen: the rest would be dark.
    const double t = std::clamp(log_wanted - 2.0, 0.0, 1.0);
    if (t == 0.0 || !too_bright(low)) return adaptation_cd_m2;
    for (int i = 0; i < 24; ++i) {
        const double middle = 0.5 * (low + high);
        (too_bright(middle) ? low : high) = middle;
    }
    return std::pow(10.0, log_wanted + t * t * (3.0 - 2.0 * t) * (high - log_wanted));
}

double point_gain(const DisplaySettings& display, double adaptation_cd_m2) noexcept {
    // Chosen by looking: eyes before a display are not as dark-adapted, nor its codes as fine, as the
    // threshold by night supposes.
    constexpr double kNightAbove = 30.0;
    constexpr double kDayAbove = 4.0;
    const double adaptation = std::max(adaptation_cd_m2, kDarkest_cd_m2);
    const ToneCurve curve = tone_curve(display, adaptation);
    if (display.tone == ToneOperator::kLinear || display.tone == ToneOperator::kReinhard)
        return std::pow(10.0, curve.p + (curve.q - 1.0) * std::log10(adaptation));
    const double room =
        display.tone == ToneOperator::kHybrid ? highlight_room(display.highlight_room, adaptation) : 0.0;
    const double field = std::pow(10.0, curve.p - room + curve.q * std::log10(adaptation));
    const double behind =
        std::max(std::min(field, display.max_luminance_cd_m2), display.black_cd_m2 + display.reflected_cd_m2);
    const double above =
        kNightAbove * std::pow(kDayAbove / kNightAbove, shaders64::photopic_share(adaptation));
    return above * threshold_lux(behind) / threshold_lux(adaptation);
}

shaders64::ToneParameters tone_parameters(const DisplaySettings& display, double adaptation_cd_m2) noexcept {
    ToneCurve curve = tone_curve(display, adaptation_cd_m2);
    if (display.tone == ToneOperator::kHybrid)
        curve.p -= highlight_room(display.highlight_room, adaptation_cd_m2);
    shaders64::ToneParameters tone{};
    tone.log2_gain = curve.p / std::numbers::ln2 * std::numbers::ln10;
    tone.exponent = curve.q;
    if (display.tone == ToneOperator::kReinhard) {
        tone.compression = 1.0;
        tone.burn = 1.0 / (kReinhardWhite * kReinhardWhite);
    }
    tone.photopic = display.night_colours ? shaders64::photopic_share(adaptation_cd_m2) : 1.0;
    tone.point_gain = point_gain(display, adaptation_cd_m2);
    tone.inv_display_max = 1.0 / display.max_luminance_cd_m2;
    tone.ambient = (display.black_cd_m2 + display.reflected_cd_m2) / display.max_luminance_cd_m2;
    tone.shoulder = display.shoulder;
    tone.encode_power = display.srgb ? 0.0 : 1.0 / display.gamma;
    return tone;
}

shaders32::ToneParameters single_precision(const shaders64::ToneParameters& tone) noexcept {
    return {static_cast<float>(tone.log2_gain),       static_cast<float>(tone.exponent),
            static_cast<float>(tone.compression),     static_cast<float>(tone.burn),
            static_cast<float>(tone.photopic),        static_cast<float>(tone.point_gain),
            static_cast<float>(tone.inv_display_max), static_cast<float>(tone.ambient),
            static_cast<float>(tone.shoulder),        static_cast<float>(tone.encode_power)};
}

DisplaySettings operator_alone(DisplaySettings display) noexcept {
    display.highlight_room = 0.0;
    display.shoulder = 1.0;
    display.night_colours = false;
    return display;
}

}  // namespace skyig::render::eye
