// What the eye model has to know of the screens, how it shows the world on them, and how fast the eye adapts.
#pragma once

#include <array>
#include <string_view>

namespace skyig::render {

/// What one screen makes of a code; screens of a rig may differ. What it shows is
/// Lamb + max_luminance * n^gamma, Lamb = black + reflected, n the code in 0..1 (sRGB: its curve for
/// n^gamma).
struct Screen {
    /// Luminance of full white beyond black, cd/m2, > 0.
    double max_luminance_cd_m2 = 350.0;
    /// Luminance that the crew's eyes are adapted to when they look at the screen, cd/m2, >= 0.1.
    double adaptation_luminance_cd_m2 = 175.0;
    /// Transfer function of the screen: the sRGB curve, or a power `gamma`.
    bool srgb = true;
    double gamma = 2.2;
    /// What it emits at code 0, and what of the cockpit's light it throws back, cd/m2, >= 0.
    double black_cd_m2 = 0.0;
    double reflected_cd_m2 = 0.0;

    friend bool operator==(const Screen&, const Screen&) = default;
};

enum class ToneOperator { kHybrid, kTumblin, kTumblinSafe, kReinhard, kWard, kLinear };
inline constexpr std::array<std::string_view, 6> kToneOperatorNames{"hybrid",   "tumblin", "tumblin-safe",
                                                                    "reinhard", "ward",    "linear"};

/// What the eye adapts to.
enum class AdaptationSource {
    kSky,      ///< log-average of directions fixed to the world
    kView,     ///< log-average of what the rig's channels see
    kViewMean  ///< its arithmetic mean
};

/// How it gets there: by two time constants, or as cones and rods do.
enum class AdaptationPace { kCockpit, kPhysiological };

/// The eye, one for the whole rig, and the screen of all channels that have none of their own.
struct DisplaySettings : Screen {
    /// +-0.5 code of ordered noise before rounding to 8 bits, fixed to the pixel.
    bool dither = true;
    ToneOperator tone = ToneOperator::kHybrid;
    /// Of kHybrid: log10 of how much darker than a field of its own luminance the log-average is shown by
    /// day, which leaves room for what is brighter, >= 0. \see eye::highlight_room()
    double highlight_room = 0.45;
    /// Part of full white above which brightness is compressed, 0..1; 1: not at all, what is brighter is
    /// clipped.
    double shoulder = 0.7;
    /// Whether colours fade to the blue-grey of the rods by night.
    bool night_colours = true;

    AdaptationSource adapt_to = AdaptationSource::kSky;
    /// > 0: the eye is adapted to this always, cd/m2.
    double fixed_adaptation_cd_m2 = 0.0;
    AdaptationPace adapt_pace = AdaptationPace::kCockpit;
    /// Time constants of kCockpit towards brighter and darker scenes, seconds of scene time.
    double adapt_up_s = 0.5;
    double adapt_down_s = 5.0;
    /// The veil that the eye's own media lay round Sun and Moon.
    bool glare = true;
};

/// The same eye before another screen.
[[nodiscard]] inline DisplaySettings before_screen(DisplaySettings display, const Screen& screen) noexcept {
    static_cast<Screen&>(display) = screen;
    return display;
}

}  // namespace skyig::render
