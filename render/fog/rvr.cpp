#include "render/fog/rvr.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skyig::render::fog {

double light_threshold_lux(double background_cd_m2) noexcept {
    const double b = std::log10(std::clamp(background_cd_m2, 1.0, 40e3));
    return std::pow(10.0, (0.05 * b + 0.573) * b - 6.667);
}

double allard_range_m(double intensity_cd, double extinction_per_m, double threshold_lux) noexcept {
    if (!(intensity_cd > 0.0) || !(threshold_lux > 0.0)) return 0.0;
    const double clear_m = std::sqrt(intensity_cd / threshold_lux);
    const double depth = std::max(extinction_per_m, 0.0) * clear_m;
    // With the range as a part exp(-y) of that in empty air: 2 y = depth exp(-y). The difference rises
    // with y and bends downwards, so that Newton's steps close in from below, after the first one at most.
    double y = std::log1p(0.5 * depth / (1.0 + std::log1p(0.5 * depth)));
    for (int i = 0; i < 12; ++i) {
        const double passed = depth * std::exp(-y);
        const double step = (2.0 * y - passed) / (2.0 + passed);
        y = std::max(y - step, 0.0);
        if (std::abs(step) <= 1e-14 * y) break;
    }
    return clear_m * std::exp(-y);
}

double koschmieder_range_m(double extinction_per_m, double contrast) noexcept {
    if (!(extinction_per_m > 0.0)) return std::numeric_limits<double>::infinity();
    return -std::log(std::clamp(contrast, 1e-6, 1.0)) / extinction_per_m;
}

RunwayVisualRange runway_visual_range(double extinction_per_m, double intensity_cd, double background_cd_m2,
                                      double contrast) noexcept {
    RunwayVisualRange range;
    range.threshold_lux = light_threshold_lux(background_cd_m2);
    range.allard_m = allard_range_m(intensity_cd, extinction_per_m, range.threshold_lux);
    range.koschmieder_m = koschmieder_range_m(extinction_per_m, contrast);
    range.range_m = std::max(range.allard_m, range.koschmieder_m);
    return range;
}

double extinction_for_range(double range_m, double intensity_cd, double background_cd_m2,
                            double contrast) noexcept {
    const double marks = -std::log(std::clamp(contrast, 1e-6, 1.0)) / range_m;
    if (!(intensity_cd > 0.0)) return marks;
    const double lux = intensity_cd / (range_m * range_m);
    const double lights = std::log(lux / light_threshold_lux(background_cd_m2)) / range_m;
    return std::max(marks, lights);
}

}  // namespace skyig::render::fog
