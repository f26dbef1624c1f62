#include "render/cloud/slab_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/cloud/slab_lookup.h"
#include "render/cloud/slab_terms.h"

namespace skyig::render::cloud {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kDeepest = 1e6F;
// Optical depth within which a cloud's surface has no direction.
constexpr float kSurface = 0.05F;

// What absorption leaves of light scattered often, at a point under and over so much cloud.
float survived(float above, float below, float absorption) noexcept {
    const float whole = above + below;
    const float back = (1.0F - passed_share(whole, absorption)) / (1.0F - passed_share(whole, 0.0F) + 1e-6F);
    return std::min(1.0F, back) * passed_share(above, absorption) / passed_share(above, 0.0F);
}

BasicSlab<double> in_double(const BasicSlab<double>& slab) noexcept {
    return slab;
}
BasicSlab<double> in_double(const BasicSlab<float>& slab) noexcept {
    return {slab.optical_depth, slab.g, slab.albedo};
}

template <class Real>
SlabFluxes<Real> by_eddington(const BasicSlab<Real>& slab, Real mu0) noexcept {
    const BasicSlab<double> known = in_double(slab);
    const auto mu = static_cast<double>(mu0);
    const SlabFluxes<double> all = eddington_fluxes(cut_peak(known), mu);
    return {static_cast<Real>(all.transmitted), static_cast<Real>(all.reflected),
            static_cast<Real>(std::exp(-known.optical_depth / mu))};
}

// Light scattered once past the cut peak (Nakajima & Tanaka, J. Quant. Spectrosc. Radiat. Transfer 40 (1988)
// 51: TMS), and what the fluxes are left with, spread evenly; below by the K(mu) of thick cloud.
template <class Real>
Real tms_brf(const BasicSlab<Real>& slab, bool above, Real mu0, Real mu, Real cos_scatter) noexcept {
    const CutSlab<Real> cut = cut_peak(slab);
    const SlabFluxes<Real> all = by_eddington(slab, mu0);
    const Real peaked = cloud_phase(CloudPhase::kHenyeyGreenstein, slab.g, cos_scatter) * slab.albedo /
                        cut.share * once_scattered(above, cut.depth, mu0, mu) / (Real(4) * mu0);
    // The flux of its smooth counterpart, by three Gauss points.
    constexpr std::array<Real, 3> kMu{Real(0.1127017), Real(0.5), Real(0.8872983)};
    constexpr std::array<Real, 3> kWeight{Real(5.0 / 18.0), Real(8.0 / 18.0), Real(5.0 / 18.0)};
    const Real turn = above ? Real(-3) : Real(3);
    Real smooth = Real(0);
    for (std::size_t i = 0; i < kMu.size(); ++i) {
        smooth += Real(2) * kMu[i] * kWeight[i] * cut.albedo * (Real(1) + turn * cut.g * mu0 * kMu[i]) *
                  once_scattered(above, cut.depth, mu0, kMu[i]) / (Real(4) * mu0);
    }
    const Real scattered = above ? all.reflected : all.transmitted - std::exp(-cut.depth / mu0);
    const Real thick = cut.depth / (Real(2) + cut.depth);
    const Real limb =
        above ? Real(1) : Real(1) + thick * (Real(3.0 / 7.0) * (Real(1) + Real(2) * mu) - Real(1));
    return peaked + std::max(Real(0), scattered - smooth) * limb;
}

// CloudScatter along a view ray through a slab: trapezoid in equal steps of what is left of the light.
float marched_brf(const Slab& slab, bool above, float mu0, float mu, float cos_scatter) noexcept {
    constexpr int kSteps = 32;
    const CloudScatter scatter(mu0, {slab.g, slab.albedo, CloudPhase::kHenyeyGreenstein});
    const CloudScatter::Ray ray = scatter.ray(above ? mu : -mu, cos_scatter);
    const float slant = slab.optical_depth / mu;
    const float taken = -std::expm1(-slant);
    float sum = 0.0F;
    for (int i = 0; i <= kSteps; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(kSteps);
        const float from_eye = std::min(-std::log1p(-std::min(part * taken, 0.9999999F)), slant) * mu;
        const float over =
            std::clamp(above ? from_eye : slab.optical_depth - from_eye, 0.0F, slab.optical_depth);
        const float weight = i == 0 || i == kSteps ? 0.5F : 1.0F;
        sum += weight * ray.source({over / mu0, over, slab.optical_depth - over});
    }
    return sum * taken / static_cast<float>(kSteps) * kPi / mu0;
}

}  // namespace

template <class Real>
SlabFluxes<Real> slab_fluxes(const BasicSlab<Real>& slab, Real mu0) noexcept {
    return table_fluxes(in_range(slab), kept_off_horizon(mu0));
}

template <class Real>
SlabFluxes<Real> slab_fluxes_diffuse(const BasicSlab<Real>& slab) noexcept {
    // 2 mu weighs the directions of even light.
    constexpr std::array<Real, 3> kMu{Real(0.1127017), Real(0.5), Real(0.8872983)};
    constexpr std::array<Real, 3> kWeight{Real(5.0 / 18.0), Real(8.0 / 18.0), Real(5.0 / 18.0)};
    SlabFluxes<Real> sum;
    for (std::size_t i = 0; i < kMu.size(); ++i) {
        const SlabFluxes<Real> one = slab_fluxes(slab, kMu[i]);
        const Real weight = Real(2) * kMu[i] * kWeight[i];
        sum.transmitted += weight * one.transmitted;
        sum.reflected += weight * one.reflected;
        sum.direct += weight * one.direct;
    }
    return sum;
}

template <class Real>
Real slab_brf(SlabModel model, const BasicSlab<Real>& asked, bool above, Real mu0_asked, Real mu_asked,
              Real cos_scatter) noexcept {
    const BasicSlab<Real> slab = in_range(asked);
    const Real mu0 = kept_off_horizon(mu0_asked);
    const Real mu = kept_off_horizon(mu_asked);
    switch (model) {
        case SlabModel::kTable:
            return table_brf(slab, above, mu0, mu, cos_scatter);
        case SlabModel::kTms:
            return tms_brf(slab, above, mu0, mu, cos_scatter);
        case SlabModel::kMarch:
            return static_cast<Real>(marched_brf(
                {static_cast<float>(slab.optical_depth), static_cast<float>(slab.g),
                 static_cast<float>(slab.albedo)},
                above, static_cast<float>(mu0), static_cast<float>(mu), static_cast<float>(cos_scatter)));
        case SlabModel::kEddington: {
            const SlabFluxes<Real> all = by_eddington(slab, mu0);
            return above ? all.reflected : std::max(Real(0), all.transmitted - all.direct);
        }
        default:
            return simple_brf(model, slab, above, mu0, mu, cos_scatter);
    }
}

CloudScatter::CloudScatter(float mu0, const CloudOptics& optics) noexcept
    : optics_(optics), mu0_(kept_off_horizon(mu0)), from_below_(mu0 < 0.0F) {
    const Slab medium = in_range(Slab{1.0F, optics.g, optics.albedo});
    optics_.g = medium.g;
    optics_.albedo = medium.albedo;
    transport_ = 1.0F - medium.albedo * medium.g;
    absorption_ = TableMedia::absorption(medium.g, medium.albedo);
}

CloudScatter::Ray CloudScatter::ray(float mu_view, float cos_scatter) const noexcept {
    const float cosine = std::clamp(cos_scatter, -1.0F, 1.0F);
    Ray ray;
    ray.scatter_ = this;
    ray.peak_ = cloud_phase(CloudPhase::kHenyeyGreenstein, optics_.g * optics_.g, cosine);
    ray.once_ = cloud_phase(optics_.phase, optics_.g, cosine) * optics_.albedo / (4.0F * kPi);
    ray.twice_ = ray.peak_ * optics_.albedo * optics_.albedo / (4.0F * kPi);
    ray.mu_ = std::clamp(from_below_ ? -mu_view : mu_view, -1.0F, 1.0F);
    const InsideView view = inside_view(optics_.g, ray.mu_);
    ray.by_g_ = view.by_g;
    ray.view_ = view.cosine.low;
    ray.view_part_ = view.cosine.part;
    ray.cosine_ = cosine;
    return ray;
}

float CloudScatter::Ray::source(const CloudPoint& asked) const noexcept {
    const CloudScatter& own = *scatter_;
    const float towards = std::clamp(asked.towards_source, 0.0F, kDeepest);
    const float over = std::clamp(own.from_below_ ? asked.below : asked.above, 0.0F, kDeepest);
    const float under = std::clamp(own.from_below_ ? asked.above : asked.below, 0.0F, kDeepest);
    // A face turned to the source is lit like the top of a slab that lies so; in a slab mu is mu0.
    const float mu = std::clamp((over + kSurface * own.mu0_) / (towards + kSurface), own.mu0_, 1.0F);
    const float depth = own.transport_ * std::min(towards * mu, kDeepest);
    const float rest = std::max(own.transport_ * over - depth, 0.0F) + own.transport_ * under;
    const InsideTable::Node terms = inside_terms({by_g_, {view_, view_part_}}, depth, rest, mu);
    const float sines = std::sqrt((1.0F - mu * mu) * (1.0F - mu_ * mu_));
    const auto modes = azimuth_modes(std::clamp(cosine_ + mu_ * mu, -sines, sines), mu, mu_);
    const float left = terms[0] + terms[1] * modes[1] + terms[2] * modes[2] + terms[3] * peak_;
    float often = mu / kPi * even_share(depth, rest) * std::max(0.0F, left);
    if (own.absorption_ > 0.0F) often *= survived(depth, rest, own.absorption_);
    return std::exp(-towards) * (once_ + twice_ * towards) + often;
}

CloudAmbient CloudScatter::ambient(const CloudPoint& point) const noexcept {
    const float above = transport_ * std::clamp(point.above, 0.0F, kDeepest);
    const float below = transport_ * std::clamp(point.below, 0.0F, kDeepest);
    const float from_above = even_share(above, below);
    return {from_above, 1.0F - from_above};
}

float slab_source(const Slab& whole, float depth_above, float mu0, float mu_view,
                  float cos_scatter) noexcept {
    const Slab slab = in_range(whole);
    const float mu = kept_off_horizon(mu0);
    const float over = std::clamp(depth_above, 0.0F, slab.optical_depth);
    const CloudScatter scatter(mu, {slab.g, slab.albedo, CloudPhase::kHenyeyGreenstein});
    return kPi / mu * scatter.ray(mu_view, cos_scatter).source({over / mu, over, slab.optical_depth - over});
}

template float slab_brf(SlabModel, const Slab&, bool, float, float, float) noexcept;
template double slab_brf(SlabModel, const Slab64&, bool, double, double, double) noexcept;
template SlabFluxes<float> slab_fluxes(const Slab&, float) noexcept;
template SlabFluxes<double> slab_fluxes(const Slab64&, double) noexcept;
template SlabFluxes<float> slab_fluxes_diffuse(const Slab&) noexcept;
template SlabFluxes<double> slab_fluxes_diffuse(const Slab64&) noexcept;

}  // namespace skyig::render::cloud
