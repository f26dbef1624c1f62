#include "render/sky/ground_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/sky/air_law.h"

namespace skyig::render::sky {
namespace {

template <class Albedo>
Spectrum spectrum_of(Albedo&& albedo) noexcept {
    Spectrum spectrum{};
    for (std::size_t i = 0; i < spectrum.size(); ++i)
        spectrum[i] =
            static_cast<float>(albedo(kFirstWavelengthNm + kWavelengthStepNm * static_cast<double>(i)));
    return spectrum;
}

// Clean snow loses a little towards the red (Wiscombe and Warren 1980); sastrugi and age take a tenth.
double snow_albedo(double nm) {
    return 0.87 - 0.04 * std::clamp((nm - 400.0) / 300.0, 0.0, 1.0);
}

// Light that comes back out of clear ocean: pi times the remote-sensing reflectance.
double water_albedo(double nm) {
    constexpr std::array<double, 9> kNm = {390, 412, 443, 490, 510, 555, 620, 670, 705};
    constexpr std::array<double, 9> kPerSr = {6.8e-3, 7.0e-3, 6.5e-3, 5.5e-3, 3.5e-3,
                                              1.7e-3, 4e-4,   1.5e-4, 5e-5};
    std::size_t k = 1;
    while (k + 1 < kNm.size() && nm > kNm[k])
        ++k;
    const double part = std::clamp((nm - kNm[k - 1]) / (kNm[k] - kNm[k - 1]), 0.0, 1.0);
    return std::numbers::pi * (kPerSr[k - 1] + part * (kPerSr[k] - kPerSr[k - 1]));
}

// Of land under a film of water: what gets in is sent back and forth below its surface (Angstrom 1925, after
// Lekner and Dorf 1988), whose diffuse reflectance is 0.066 from above and 1 - 0.934 / 1.33^2 from below.
// What the film mirrors is not in it.
double wet_albedo(double dry) {
    constexpr double kEnters = 1.0 - 0.066;
    constexpr double kHeld = 1.0 - kEnters / (1.33 * 1.33);
    return kEnters * (1.0 - kHeld) * dry / (1.0 - kHeld * dry);
}

void lay_land(const Ground& ground, AirModel& model) noexcept {
    const double bare = luminous_albedo(model, spectrum_of(bare_land_albedo));
    const double told = ground.albedo && std::isfinite(*ground.albedo) ? *ground.albedo : bare;
    const double scale = std::clamp(told, 0.0, 1.0) / bare;
    // In steps: land that dries or whitens asks for new air now and then, not in every frame.
    const auto in_steps = [](double share, double steps) {
        return std::isfinite(share) ? std::round(steps * std::clamp(share, 0.0, 1.0)) / steps : 0.0;
    };
    const double snow = in_steps(ground.snow, 100.0);
    const double wet = in_steps(ground.wet, 16.0);
    model.ground_albedo = spectrum_of([&](double nm) {
        const double dry = std::min(scale * bare_land_albedo(nm), 1.0);
        const double land = dry + wet * (wet_albedo(dry) - dry);
        return land + snow * (snow_albedo(nm) - land);
    });
}

void lay_sea(AirModel& model) noexcept {
    model.ground_mirror_albedo = 0.05F;
    model.ground_albedo = spectrum_of(water_albedo);
    for (float& albedo : model.ground_albedo)
        albedo += model.ground_mirror_albedo;
}

}  // namespace

void lay_ground(const Ground& ground, AirModel& model) noexcept {
    if (ground.kind == Ground::Kind::kSea) {
        lay_sea(model);
    } else {
        lay_land(ground, model);
    }
}

}  // namespace skyig::render::sky
