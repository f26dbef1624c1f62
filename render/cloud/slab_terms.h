// What several of the slab models are made of (same folder).
#pragma once

#include <algorithm>
#include <cmath>

#include "render/cloud/slab_light.h"

namespace skyig::render::cloud {

/// (1 - exp(-x)) / x, 1 at 0. x >= 0
template <class Real>
[[nodiscard]] inline Real escape(Real x) noexcept {
    return x < Real(1e-3) ? Real(1) - x * (Real(0.5) - x / Real(6)) : -std::expm1(-x) / x;
}

/// A medium whose forward peak, the part f = g^2 of its scattering, counts as not scattered: Joseph, Wiscombe
/// & Weinman, J. Atmos. Sci. 33 (1976) 2452.
template <class Real>
struct CutSlab {
    Real share;  ///< of the optical depth that is left
    Real depth;
    Real g;
    Real albedo;
};
template <class Real>
[[nodiscard]] inline CutSlab<Real> cut_peak(const BasicSlab<Real>& slab) noexcept {
    const Real peak = slab.g * slab.g;
    const Real share = Real(1) - slab.albedo * peak;
    return {share, share * slab.optical_depth, slab.g / (Real(1) + slab.g),
            slab.albedo * (Real(1) - peak) / share};
}

/// Light scattered once on its way out, of a phase function 4 mu0 pi / albedo; cosines > 0.
template <class Real>
[[nodiscard]] inline Real once_scattered(bool above, Real depth, Real mu0, Real mu) noexcept {
    const Real in = Real(1) / mu0;
    const Real out = Real(1) / mu;
    if (above) return mu0 / (mu0 + mu) * -std::expm1(-(in + out) * depth);
    return out * depth * std::exp(-std::min(in, out) * depth) * escape(std::abs(in - out) * depth);
}

/// Cosines so that no term divides by nothing: the light of a ray closer to the horizontal is this one's.
template <class Real>
[[nodiscard]] inline Real kept_off_horizon(Real mu) noexcept {
    return std::clamp(std::abs(mu), Real(1e-4), Real(1));
}

/// Inside the ranges that the models are made for.
template <class Real>
[[nodiscard]] inline BasicSlab<Real> in_range(const BasicSlab<Real>& slab) noexcept {
    return {std::clamp(slab.optical_depth, Real(0), Real(1e6)), std::clamp(slab.g, Real(0), Real(0.95)),
            std::clamp(slab.albedo, Real(0), Real(1))};
}

/// Fluxes of the cut slab by Eddington's approximation; double, for its terms cancel.
[[nodiscard]] SlabFluxes<double> eddington_fluxes(const CutSlab<double>& cut, double mu0) noexcept;

/// The seeds' models and the common practice, all in the same units.
template <class Real>
[[nodiscard]] Real simple_brf(SlabModel model, const BasicSlab<Real>& slab, bool above, Real mu0, Real mu,
                              Real cos_scatter) noexcept;

}  // namespace skyig::render::cloud
