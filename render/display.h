// What the eye model has to know of the display, and how fast the eye adapts.
#pragma once

namespace skyig::render {

enum class ToneOperator { kHybrid, kLinear };

struct DisplaySettings {
    /// Luminance of full white, cd/m2, > 0.
    double max_luminance_cd_m2 = 350.0;
    /// Luminance that the crew's eyes are adapted to when they look at the display, cd/m2, >= 0.1.
    double adaptation_luminance_cd_m2 = 175.0;
    /// Transfer function of the display: the sRGB curve, or a power `gamma`.
    bool srgb = true;
    double gamma = 2.2;
    /// +-0.5 code of ordered noise before rounding to 8 bits, fixed to the pixel.
    bool dither = true;
    ToneOperator tone = ToneOperator::kHybrid;
    /// Time constants of adaptation towards brighter and darker scenes, seconds of scene time.
    double adapt_up_s = 0.5;
    double adapt_down_s = 5.0;
    /// The veil that the eye's own media lay round Sun and Moon.
    bool glare = true;
};

}  // namespace skyig::render
