#include "server/start_weather/genus.h"

namespace skyig::server {

using config::LayerType;

LayerType likely_genus(double base_agl_m, double coverage) noexcept {
    // Between four oktas (scattered) and five (broken); between seven (broken) and eight.
    const bool broken = coverage > 4.5 / 8.0;
    const bool overcast = coverage > 7.5 / 8.0;
    if (base_agl_m < 500.0) return broken ? LayerType::kStratus : LayerType::kCumulus;
    if (base_agl_m < 2000.0) return broken ? LayerType::kStratocumulus : LayerType::kCumulus;
    if (base_agl_m < 6000.0) return overcast ? LayerType::kAltostratus : LayerType::kAltocumulus;
    return overcast ? LayerType::kCirrostratus : LayerType::kCirrus;
}

double usual_thickness_m(LayerType cloud) noexcept {
    switch (cloud) {
        case LayerType::kCumulonimbus:
            return 8000.0;
        case LayerType::kNimbostratus:
            return 3000.0;
        case LayerType::kAltostratus:
            return 2000.0;
        case LayerType::kCirrus:
        case LayerType::kCirrostratus:
            return 1000.0;
        case LayerType::kCumulus:
            return 800.0;
        case LayerType::kStratocumulus:
            return 500.0;
        case LayerType::kAltocumulus:
            return 400.0;
        default:
            break;
    }
    return 300.0;
}

}  // namespace skyig::server
