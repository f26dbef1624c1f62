// How the air is layered: what of an air does not depend on the wavelength.
#pragma once

#include <array>
#include <cstddef>

namespace skyig::render::sky {

/// Density relative to that at height 0, log-linear between knots of rising height (the first at 0); the last
/// slope goes on above the last knot. Two knots make one exponential.
struct DensityProfile {
    static constexpr std::size_t kMaxKnots = 28;
    std::size_t knot_count = 0;
    std::array<double, kMaxKnots> height_m{};
    std::array<double, kMaxKnots> log_density{};

    friend bool operator==(const DensityProfile&, const DensityProfile&) = default;
};

/// Spherical shell of molecules, aerosol and ozone over level ground.
struct AirShape {
    double ground_radius_m = 6371.0e3;
    double top_height_m = 120.0e3;
    /// Refractive index less one at height 0, falling as in the standard atmosphere: what bends the light of
    /// a source on its way in. 0: it comes straight.
    double refractivity = 0.0;
    DensityProfile molecules;
    double aerosol_scale_height_m = 1200.0;
    /// Cornette-Shanks parameter (not the mean cosine), the same at all wavelengths.
    double aerosol_g = 0.75;
    double ozone_bottom_m = 10.0e3;
    double ozone_peak_m = 25.0e3;
    double ozone_top_m = 40.0e3;

    friend bool operator==(const AirShape&, const AirShape&) = default;
};

}  // namespace skyig::render::sky
