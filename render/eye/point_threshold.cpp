#include "render/eye/point_threshold.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::eye {

namespace {

constexpr double kNanolambert_cd_m2 = 3.1831e-6;
constexpr double kFootcandle_lux = 10.764;

struct Branch {
    double c_footcandle;
    double k_per_nanolambert;
};
constexpr Branch kRods{1.5848932e-10, 1.2589254e-2};
constexpr Branch kCones{4.4668359e-9, 1.2589254e-6};

}  // namespace

double threshold_lux(double background_cd_m2) noexcept {
    const double nanolamberts = std::max(background_cd_m2, 1e-9) / kNanolambert_cd_m2;
    const auto footcandles = [nanolamberts](const Branch& branch) {
        const double root = 1.0 + std::sqrt(branch.k_per_nanolambert * nanolamberts);
        return branch.c_footcandle * root * root;
    };
    return kFootcandle_lux * std::min(footcandles(kRods), footcandles(kCones));
}

}  // namespace skyig::render::eye
