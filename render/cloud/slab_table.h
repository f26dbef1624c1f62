// What the tables of multiply scattered light hold, and where (same folder and generator/): one home for
// axes and scales. Each table holds what a closed form leaves over, at the nodes of smooth coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/cloud/slab_terms.h"

namespace skyig::render::cloud {

/// Media of the tables: by asymmetry, then by absorption.
struct TableMedia {
    static constexpr std::array<double, 2> kG{0.75, 0.85};
    /// sqrt((1 - albedo) / (1 - albedo g)): what alike media share (van de Hulst 1980, 14.1).
    static constexpr std::array<double, 3> kAbsorption{0.0, 0.08, 0.25};

    template <class Real>
    [[nodiscard]] static Real absorption(Real g, Real albedo) noexcept {
        return std::sqrt(std::max(Real(0), (Real(1) - albedo) / (Real(1) - albedo * g)));
    }
    [[nodiscard]] static constexpr double albedo(double g, double absorption) noexcept {
        return (1.0 - absorption * absorption) / (1.0 - g * absorption * absorption);
    }
};

/// Depth by the transport depth (1 - albedo g) tau: u = t / (t + kHalf), 0 none .. 1 infinite.
struct DepthAxis {
    static constexpr double kHalf = 0.75;

    template <class Real>
    [[nodiscard]] static Real place(Real transport) noexcept {
        return transport / (transport + Real(kHalf));
    }
};

/// Cosines, fine at both ends: grazing light changes fastest, and light near the vertical has its peaks.
struct CosineAxis {
    template <class Real>
    [[nodiscard]] static Real place(Real mu) noexcept {
        const Real root = std::sqrt(mu);
        return root / (root + std::sqrt(Real(1) - mu));
    }
    /// Of a place 0..1. The lower end is taken a little inside, where all that is scaled has its limit.
    [[nodiscard]] static double cosine(double place) noexcept {
        const double other = 1.0 - place;
        return std::max(place * place / (place * place + other * other), 1e-3);
    }
    /// Of any sign: -1 is 0, 0 is 0.5, 1 is 1.
    template <class Real>
    [[nodiscard]] static Real signed_place(Real mu) noexcept {
        return Real(0.5) + Real(0.5) * std::copysign(place(std::abs(mu)), mu);
    }
};

/// Depth inside a slab: 0 top .. 1 base, fine near both.
struct PlaceAxis {
    /// In transport depth.
    static constexpr double kHalf = 0.3;

    template <class Real>
    [[nodiscard]] static Real place(Real above, Real below) noexcept {
        const Real over = above * (below + Real(kHalf));
        const Real under = below * (above + Real(kHalf));
        return over + under > Real(0) ? over / (over + under) : Real(0.5);
    }
};

/// Even light that a slab of this transport depth lets through, about: what light below it falls with.
template <class Real>
[[nodiscard]] inline Real passed_share(Real transport, Real absorption) noexcept {
    const Real k = Real(1.7320508) * absorption;
    const Real slope = k * transport;
    if (slope < Real(1e-3)) return Real(1) / (Real(1) + Real(0.75) * transport);
    const Real fade = std::exp(-slope);
    return Real(2) * fade / ((Real(1) + fade * fade) + Real(0.75) / k * (Real(1) - fade * fade));
}

/// Part of even light from one side that reaches a point, by the diffusion law; transport depths to that side
/// and to the other.
template <class Real>
[[nodiscard]] inline Real even_share(Real near, Real far) noexcept {
    return (Real(0.5) + Real(0.75) * far) / (Real(1) + Real(0.75) * (near + far));
}

/// Light scattered once or twice where all angles are small: in it order n is scattered by HG(g^n), and
/// comes after n - 1 scatterings on the way. Factors of those two phase functions; cosines > 0.
template <class Real>
[[nodiscard]] inline std::array<Real, 2> first_orders(bool above, Real depth, Real mu0, Real mu,
                                                      Real albedo) noexcept {
    const Real in = depth / mu0;
    const Real out = depth / mu;
    if (above) {
        const Real gone = std::exp(-(in + out));
        const Real first = -std::expm1(-(in + out));
        const Real scale = albedo / (Real(4) * (mu0 + mu));
        return {scale * first, scale * albedo * std::max(Real(0), first - (in + out) * gone)};
    }
    // Over the slant depth x of a path, evenly from `in` to `out`: exp(-x) and x exp(-x).
    const Real least = std::min(in, out);
    const Real width = std::abs(in - out);
    const Real fade = std::exp(-least);
    const Real once = escape(width);
    // (1 - (1 + w) exp(-w)) / w, 0 at 0.
    const Real spread = width < Real(0.02) ? width * (Real(0.5) - width / Real(3)) : once - std::exp(-width);
    const Real scale = albedo * out / (Real(4) * mu0) * fade;
    return {scale * once, scale * albedo * (least * once + spread)};
}

/// What multiply scattered light of thin slabs goes with at grazing angles.
template <class Real>
[[nodiscard]] inline Real caught(Real depth, Real mu0, Real mu) noexcept {
    return std::expm1(-depth / mu0) * std::expm1(-depth / mu);
}

/// Modes 0, 1, 2 of the azimuth as polynomials of the scattering angle: free of azimuth where it has no
/// meaning. \param turn  cos_scatter less its vertical part: both sines times cos(azimuth)
template <class Real>
[[nodiscard]] inline std::array<Real, 3> azimuth_modes(Real turn, Real mu0, Real mu) noexcept {
    return {Real(1), turn, Real(2) * turn * turn - (Real(1) - mu0 * mu0) * (Real(1) - mu * mu)};
}

/// Table of light that leaves a slab: factors of azimuth_modes(), and of the second order's phase function,
/// at each pair of cosines.
struct LeavingTable {
    static constexpr std::size_t kDepths = 12;
    static constexpr std::size_t kCosines = 10;
    static constexpr std::size_t kPairs = kCosines * (kCosines + 1) / 2;
    using Node = std::array<float, 4>;
    using Depths = std::array<std::array<Node, kPairs>, kDepths>;
    /// Scattered fluxes up and down, over what the beam loses (and passed_share() below), by the source.
    using Fluxes = std::array<std::array<std::array<float, 2>, kCosines>, kDepths>;
    struct Medium {
        Depths above;
        Depths below;
        Fluxes fluxes;
    };
    [[nodiscard]] static constexpr std::size_t pair(std::size_t a, std::size_t b) noexcept {
        return a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b;
    }
};
/// By asymmetry, then absorption.
extern const std::array<LeavingTable::Medium, 6> kLeavingTables;

/// Table of the source function inside, the same factors: by the view's cosine (of any sign), the source's,
/// depth of the slab, place in it.
struct InsideTable {
    static constexpr std::size_t kViews = 11;
    static constexpr std::size_t kSources = 7;
    static constexpr std::size_t kDepths = 10;
    static constexpr std::size_t kPlaces = 9;
    using Node = std::array<float, 4>;
    using Slabs = std::array<std::array<Node, kPlaces>, kDepths>;
    using Medium = std::array<std::array<Slabs, kSources>, kViews>;
};
/// By asymmetry, without absorption.
extern const std::array<InsideTable::Medium, 2> kInsideTables;

}  // namespace skyig::render::cloud
