#include "render/sky/standard_air.h"

#include <cmath>

namespace skyig::render::sky {
namespace {

// Of the geopotential; the same that the standard fixes its heights with.
constexpr double kGeopotentialRadius_m = 6356766.0;
// g0 M / R*, kelvin per geopotential metre.
constexpr double kHydrostatic_k_per_m = 0.0341631947;

struct Layer {
    double base_m;  // geopotential
    double base_k;
    double lapse_k_per_m;
};
constexpr std::array<Layer, 7> kStandard{{{0.0, 288.15, -6.5e-3},
                                          {11e3, 216.65, 0.0},
                                          {20e3, 216.65, 1e-3},
                                          {32e3, 228.65, 2.8e-3},
                                          {47e3, 270.65, 0.0},
                                          {51e3, 270.65, -2.8e-3},
                                          {71e3, 214.65, -2e-3}}};

double density_ratio(const Layer& layer, double above_base_m) {
    if (layer.lapse_k_per_m == 0.0) return std::exp(-kHydrostatic_k_per_m * above_base_m / layer.base_k);
    const double warmer = 1.0 + layer.lapse_k_per_m * above_base_m / layer.base_k;
    return std::pow(warmer, -1.0 - kHydrostatic_k_per_m / layer.lapse_k_per_m);
}

}  // namespace

StandardAir::StandardAir() noexcept {
    base_refractivity_[0] = kSeaLevelRefractivity;
    for (std::size_t i = 1; i < kLayers; ++i) {
        base_refractivity_[i] =
            base_refractivity_[i - 1] *
            density_ratio(kStandard[i - 1], kStandard[i].base_m - kStandard[i - 1].base_m);
    }
}

StandardAir::At StandardAir::in_layer(std::size_t i, double height_m) const noexcept {
    const double part = kGeopotentialRadius_m / (kGeopotentialRadius_m + height_m);
    const Layer& layer = kStandard[i];
    const double above_m = part * height_m - layer.base_m;
    const double temperature_k = layer.base_k + layer.lapse_k_per_m * above_m;
    const double refractivity = base_refractivity_[i] * density_ratio(layer, above_m);
    return {refractivity,
            -refractivity * (kHydrostatic_k_per_m + layer.lapse_k_per_m) / temperature_k * part * part};
}

StandardAir::At StandardAir::at(double height_m) const noexcept {
    if (!(height_m < kRefractionTop_m)) return {};
    const double share = (height_m - kTropopause_m) / (2.0 * kTropopauseRounding_m) + 0.5;
    if (share > 0.0 && share < 1.0) {
        const At below = in_layer(0, height_m);
        const At above = in_layer(1, height_m);
        const double weight = share * share * (3.0 - 2.0 * share);
        const double weight_slope = 3.0 * share * (1.0 - share) / kTropopauseRounding_m;
        const double apart = std::log(above.refractivity / below.refractivity);
        const double refractivity = below.refractivity * std::exp(weight * apart);
        const double slope = (1.0 - weight) * below.slope_per_m / below.refractivity +
                             weight * above.slope_per_m / above.refractivity + weight_slope * apart;
        return {refractivity, refractivity * slope};
    }
    const double geopotential_m = kGeopotentialRadius_m * height_m / (kGeopotentialRadius_m + height_m);
    std::size_t i = kLayers - 1;
    while (i > 0 && geopotential_m < kStandard[i].base_m)
        --i;
    return in_layer(i, height_m);
}

}  // namespace skyig::render::sky
