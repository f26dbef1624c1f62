// A screen as configured: [display] for all channels, [channel.display] for one.
#pragma once

#include <optional>

namespace skyig::config {

struct Screen {
    /// Luminance of full white on the screen, 1..10000.
    double max_luminance_cd_m2 = 350.0;
    /// What the eyes in front of the screen are adapted to; if not given, half of full white.
    double adaptation_cd_m2 = 175.0;
    /// Exponent of the screen's response; empty ("srgb" in the file): the sRGB curve. 1..3.
    std::optional<double> gamma;
    /// What it emits at code 0, and what of the cockpit's light it throws back, 0..1000.
    double black_cd_m2 = 0.0;
    double reflected_cd_m2 = 0.0;

    friend bool operator==(const Screen&, const Screen&) = default;
};

}  // namespace skyig::config
