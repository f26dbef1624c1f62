#include "render/sky/reference/medium.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::sky::reference {

Medium::Medium(const AirLaw& law)
    : shape_(law.shape),
      shell_{law.shape.ground_radius_m, law.shape.top_height_m},
      sunlight_(law.sunlight_w_m2_nm) {
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        const AirOptics optics = law.optics(kFirstSampleNm + kSampleStepNm * static_cast<double>(i));
        rayleigh_[i] = optics.rayleigh_per_m;
        aerosol_extinction_[i] = optics.aerosol_extinction_per_m;
        aerosol_scattering_[i] = optics.aerosol_scattering_per_m;
        ozone_[i] = optics.ozone_peak_per_m;
        ground_albedo_[i] = optics.ground_albedo;
    }
    const DensityProfile& profile = shape_.molecules;
    std::uint8_t knot = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        const double foot_m = shell_.top_height_m * static_cast<double>(bin) / kBins;
        while (knot + std::size_t{2} < profile.knot_count &&
               profile.height_m[knot + std::size_t{1}] <= foot_m)
            ++knot;
        first_knot_[bin] = knot;
    }
}

Triple Medium::densities(double height_m) const noexcept {
    const double h = std::clamp(height_m, 0.0, shell_.top_height_m);
    const DensityProfile& profile = shape_.molecules;
    const auto bin = std::min(static_cast<std::size_t>(h / shell_.top_height_m * kBins), kBins - 1);
    std::size_t k = first_knot_[bin];
    while (k + 2 < profile.knot_count && h > profile.height_m[k + 1])
        ++k;
    const double part = (h - profile.height_m[k]) / (profile.height_m[k + 1] - profile.height_m[k]);
    const double up = (h - shape_.ozone_bottom_m) / (shape_.ozone_peak_m - shape_.ozone_bottom_m);
    const double down = (shape_.ozone_top_m - h) / (shape_.ozone_top_m - shape_.ozone_peak_m);
    return {std::exp(std::lerp(profile.log_density[k], profile.log_density[k + 1], part)),
            std::exp(-h / shape_.aerosol_scale_height_m), std::max(0.0, std::min(up, down))};
}

Samples Medium::transmittance(const Triple& column_m) const noexcept {
    Samples part{};
    for (std::size_t i = 0; i < kSampleCount; ++i)
        part[i] = std::exp(-extinction(column_m, i));
    return part;
}

}  // namespace skyig::render::sky::reference
