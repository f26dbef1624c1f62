#include <cmath>

#include "render/cloud/slab_terms.h"

namespace skyig::render::cloud {

namespace {

// Seed 001 in a slab: opacity and self-shadow are powers of one density, whatever the direction. Rates and
// shares are the reference's best for g 0.85 (clouds-and-weather, section 4).
template <class Real>
Real layer_brf(bool quadratic, Real depth) noexcept {
    constexpr Real kOpacity = Real(0.041);
    constexpr Real kShadow = Real(0.082);
    constexpr Real kSunlight = Real(2.04);
    constexpr Real kAmbient = Real(0.074);
    const auto left = [quadratic](Real x) {
        const Real line = std::max(Real(0), Real(1) - Real(0.5) * x);
        return quadratic ? line * line : std::exp(-x);
    };
    return (Real(1) - left(kOpacity * depth)) * (left(kShadow * depth) * kSunlight + kAmbient);
}

// Seed 004 in a slab: lit where a sample one optical depth nearer to the light is outside of it.
template <class Real>
Real one_sample_brf(const BasicSlab<Real>& slab, bool above, Real mu0, Real mu, Real phase) noexcept {
    const Real lit = std::min(mu0, slab.optical_depth);
    const Real before = above ? Real(0) : slab.optical_depth - lit;
    return slab.albedo * phase / (Real(4) * mu0) * std::exp(-before / mu) * -std::expm1(-lit / mu);
}

// Seed 003 for many small particles: light handed on along its way gains what each sends forward into
// 0.09 sr (Harris & Lastra 2001), and the eye sees each through those before it.
template <class Real>
Real particles_brf(const BasicSlab<Real>& slab, bool above, Real mu0, Real mu, Real phase) noexcept {
    constexpr Real kGathered = Real(0.09 / (4.0 * 3.14159265358979));
    const Real forward = cloud_phase(CloudPhase::kHenyeyGreenstein, slab.g, Real(1));
    const Real lost = std::max(Real(1e-3), Real(1) - slab.albedo * forward * kGathered);
    return slab.albedo * phase / (Real(4) * mu0) * once_scattered(above, slab.optical_depth, mu0 / lost, mu);
}

// Wrenninge 2013: octave i has half the light, extinction and asymmetry of the one before.
template <class Real>
Real octaves_brf(const BasicSlab<Real>& slab, bool above, Real mu0, Real mu, Real cos_scatter) noexcept {
    constexpr int kOctaves = 8;
    Real sum = Real(0);
    Real part = Real(1);
    for (int i = 0; i < kOctaves; ++i, part *= Real(0.5)) {
        sum += part * cloud_phase(CloudPhase::kHenyeyGreenstein, slab.g * part, cos_scatter) *
               once_scattered(above, slab.optical_depth, mu0 / part, mu);
    }
    return slab.albedo * sum / (Real(4) * mu0);
}

}  // namespace

template <class Real>
Real simple_brf(SlabModel model, const BasicSlab<Real>& slab, bool above, Real mu0, Real mu,
                Real cos_scatter) noexcept {
    const Real phase = cloud_phase(CloudPhase::kHenyeyGreenstein, slab.g, cos_scatter);
    switch (model) {
        case SlabModel::kLayer:
        case SlabModel::kLayerQuadratic:
            return layer_brf(model == SlabModel::kLayerQuadratic, slab.optical_depth);
        case SlabModel::kOneSample:
            return one_sample_brf(slab, above, mu0, mu, phase);
        case SlabModel::kParticles:
            return particles_brf(slab, above, mu0, mu, phase);
        case SlabModel::kOctaves:
            return octaves_brf(slab, above, mu0, mu, cos_scatter);
        default:
            break;
    }
    return slab.albedo * phase / (Real(4) * mu0) * once_scattered(above, slab.optical_depth, mu0, mu);
}

// Meador & Weaver, J. Atmos. Sci. 37 (1980) 630, table 1 (Eddington), eqs. 14 and 15, with exp(-k depth)
// taken out; without absorption their eq. 24.
SlabFluxes<double> eddington_fluxes(const CutSlab<double>& cut, double mu0) noexcept {
    constexpr double kLossless = 1e-8;
    const double beam = std::exp(-cut.depth / mu0);
    const double w = cut.albedo;
    if (1.0 - w < kLossless) {
        const double transmitted = std::clamp(
            (2.0 + 3.0 * mu0 + (2.0 - 3.0 * mu0) * beam) / (4.0 + 3.0 * (1.0 - cut.g) * cut.depth), 0.0, 1.0);
        return {transmitted, 1.0 - transmitted, beam};
    }
    const double gamma1 = (7.0 - w * (4.0 + 3.0 * cut.g)) / 4.0;
    const double gamma2 = -(1.0 - w * (4.0 - 3.0 * cut.g)) / 4.0;
    const double gamma3 = (2.0 - 3.0 * cut.g * mu0) / 4.0;
    const double gamma4 = 1.0 - gamma3;
    const double alpha1 = gamma1 * gamma4 + gamma2 * gamma3;
    const double alpha2 = gamma1 * gamma3 + gamma2 * gamma4;
    double k = std::sqrt((gamma1 - gamma2) * (gamma1 + gamma2));
    if (std::abs(1.0 - k * mu0) < 1e-4) k *= 1.0 + 2e-4;
    const double fade = std::exp(-k * cut.depth);
    const double below = (1.0 - k * mu0) * (1.0 + k * mu0) * ((k + gamma1) + (k - gamma1) * fade * fade);
    const double reflected =
        w / below *
        ((1.0 - k * mu0) * (alpha2 + k * gamma3) - (1.0 + k * mu0) * (alpha2 - k * gamma3) * fade * fade -
         2.0 * k * (gamma3 - alpha2 * mu0) * fade * beam);
    const double transmitted = beam - w / below *
                                          ((1.0 + k * mu0) * (alpha1 + k * gamma4) * beam -
                                           (1.0 - k * mu0) * (alpha1 - k * gamma4) * fade * fade * beam -
                                           2.0 * k * (gamma4 + alpha1 * mu0) * fade);
    const double passed = std::clamp(transmitted, 0.0, 1.0);
    return {passed, std::clamp(reflected, 0.0, 1.0 - passed), beam};
}

template float simple_brf(SlabModel, const Slab&, bool, float, float, float) noexcept;
template double simple_brf(SlabModel, const Slab64&, bool, double, double, double) noexcept;

}  // namespace skyig::render::cloud
