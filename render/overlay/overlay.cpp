#include "render/overlay/overlay.h"

#include <cmath>

namespace skyig::render {

double text_code(double adaptation_cd_m2) noexcept {
    // From a moonlit night to an overcast day, evenly over the decades.
    constexpr double kNight_log10 = -2.0;
    constexpr double kDay_log10 = 2.0;
    const double decade = std::log10(std::max(adaptation_cd_m2, 1e-9));
    const double day = std::clamp((decade - kNight_log10) / (kDay_log10 - kNight_log10), 0.0, 1.0);
    return kNightTextCode + (kDayTextCode - kNightTextCode) * day;
}

}  // namespace skyig::render
