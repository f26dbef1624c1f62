// Phase functions, normalised to 1 over the sphere; the cosine is 1 where light keeps its direction.
#pragma once

#include <cmath>
#include <numbers>

namespace skyig::render::sky {

template <class Real>
[[nodiscard]] inline Real rayleigh_phase(Real cosine) noexcept {
    return Real(3.0 / (16.0 * std::numbers::pi)) * (Real(1) + cosine * cosine);
}

/// Cornette & Shanks, Appl. Opt. 31 (1992) 3152.
template <class Real>
[[nodiscard]] inline Real cornette_shanks_phase(Real g, Real cosine) noexcept {
    const Real base = (Real(1) - g) * (Real(1) - g) + Real(2) * g * (Real(1) - cosine);
    return Real(3.0 / (8.0 * std::numbers::pi)) * (Real(1) - g * g) / (Real(2) + g * g) *
           (Real(1) + cosine * cosine) / (base * std::sqrt(base));
}

/// Mean cosine of the above.
[[nodiscard]] inline double cornette_shanks_mean_cosine(double g) noexcept {
    return 3.0 * g * (4.0 + g * g) / (5.0 * (2.0 + g * g));
}

}  // namespace skyig::render::sky
