#include "render/night/star_colour.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::night {
namespace {

constexpr double cubic(double t, double a3, double a2, double a1, double a0) noexcept {
    return ((a3 * t + a2) * t + a1) * t + a0;
}

}  // namespace

double temperature_from_bv_k(double bv) noexcept {
    const double clamped = std::clamp(bv, kMinBv, kMaxBv);
    return 4600.0 * (1.0 / (0.92 * clamped + 1.7) + 1.0 / (0.92 * clamped + 0.62));
}

glm::dvec2 planckian_xy(double temperature_k) noexcept {
    const double kelvin = std::clamp(temperature_k, 1667.0, 25000.0);
    const double t = 1000.0 / kelvin;
    const double x = kelvin <= 4000.0 ? cubic(t, -0.2661239, -0.2343589, 0.8776956, 0.179910)
                                      : cubic(t, -3.0258469, 2.1070379, 0.2226347, 0.240390);
    if (kelvin <= 2222.0) return {x, cubic(x, -1.1063814, -1.34811020, 2.18555832, -0.20219683)};
    if (kelvin <= 4000.0) return {x, cubic(x, -0.9549476, -1.37418593, 2.09137015, -0.16748867)};
    return {x, cubic(x, 3.0817580, -5.87338670, 3.75112997, -0.37001483)};
}

glm::dvec3 linear_rec709_of_xy(const glm::dvec2& xy) noexcept {
    const glm::dvec3 xyz(xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y);
    // IEC 61966-2-1, inverse of its primaries and white, written by columns.
    constexpr glm::dmat3 kRec709FromXyz(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259,
                                        -0.4985314, 0.0415560, 1.0572252);
    const glm::dvec3 rgb = kRec709FromXyz * xyz;
    const double least = std::min({rgb.x, rgb.y, rgb.z});
    if (least >= 0.0) return rgb;
    // White has luminance 1 as well, so mixing it in leaves the luminance alone; the least component ends at
    // zero.
    const glm::dvec3 mixed = (rgb - least) / (1.0 - least);
    return glm::max(mixed, glm::dvec3(0.0));
}

glm::dvec3 star_colour_of_bv(double bv) noexcept {
    constexpr double kSunBv = 0.65;
    return linear_rec709_of_xy(planckian_xy(temperature_from_bv_k(std::isnan(bv) ? kSunBv : bv)));
}

double star_illuminance_lux(double vmag) noexcept {
    constexpr double kMagnitudeZero_lux = 2.54e-6;
    return kMagnitudeZero_lux * std::pow(10.0, -0.4 * vmag);
}

}  // namespace skyig::render::night
