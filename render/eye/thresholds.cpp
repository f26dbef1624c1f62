#include "render/eye/thresholds.h"

#include <cmath>

namespace skyig::render::eye {

double log_threshold_cones(double log_l) noexcept {
    if (log_l <= -2.6) return -0.72;
    if (log_l >= 1.9) return log_l - 1.255;
    return std::pow(0.249 * log_l + 0.65, 2.7) - 0.72;
}

double log_threshold_rods(double log_l) noexcept {
    if (log_l <= -3.94) return -2.86;
    if (log_l >= -1.44) return log_l - 0.395;
    return std::pow(0.405 * log_l + 1.6, 2.18) - 2.86;
}

}  // namespace skyig::render::eye
