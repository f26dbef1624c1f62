#include "render/cloud/slab_lookup.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::cloud {

namespace {

// Shares of the tables' media in another one: straight in g, by the parabola through all three in absorption.
struct Shares {
    std::array<float, TableMedia::kG.size()> by_g{};
    std::array<float, TableMedia::kAbsorption.size()> by_absorption{1.0F, 0.0F, 0.0F};
};

Shares shares_of(float g, float absorption) noexcept {
    constexpr auto kLow = static_cast<float>(TableMedia::kG[0]);
    constexpr auto kStep = static_cast<float>(TableMedia::kG[1] - TableMedia::kG[0]);
    constexpr auto kWeak = static_cast<float>(TableMedia::kAbsorption[1]);
    constexpr auto kStrong = static_cast<float>(TableMedia::kAbsorption[2]);
    // The tables reach as far beyond their media as light keeps alike.
    const float part = std::clamp((g - kLow) / kStep, -0.5F, 1.5F);
    Shares shares;
    shares.by_g = {1.0F - part, part};
    const float s = std::min(absorption, kStrong);
    // Less is not seen.
    if (s < 1e-4F) return shares;
    shares.by_absorption = {(s - kWeak) * (s - kStrong) / (kWeak * kStrong),
                            s * (s - kStrong) / (kWeak * (kWeak - kStrong)),
                            s * (s - kWeak) / (kStrong * (kStrong - kWeak))};
    return shares;
}

struct Corner {
    std::size_t pair;
    float weight;
};

void add(LeavingTable::Node& sum, float weight, const LeavingTable::Node& node) noexcept {
    for (std::size_t term = 0; term < sum.size(); ++term)
        sum[term] += weight * node[term];
}

LeavingTable::Node leaving_terms(const Shares& shares, bool above, const Between& depth, const Between& in,
                                 const Between& out) noexcept {
    // In triangles along the diagonal, where forward light has its ridge.
    const bool steeper_in = in.part >= out.part;
    const std::array<Corner, 3> corners{
        {{LeavingTable::pair(in.low, out.low), 1.0F - std::max(in.part, out.part)},
         {LeavingTable::pair(in.low + (steeper_in ? 1 : 0), out.low + (steeper_in ? 0 : 1)),
          std::abs(in.part - out.part)},
         {LeavingTable::pair(in.low + 1, out.low + 1), std::min(in.part, out.part)}}};
    LeavingTable::Node sum{};
    for (std::size_t g = 0; g < shares.by_g.size(); ++g) {
        for (std::size_t s = 0; s < shares.by_absorption.size(); ++s) {
            const float share = shares.by_g[g] * shares.by_absorption[s];
            if (share == 0.0F) continue;
            const LeavingTable::Medium& medium = kLeavingTables[g * shares.by_absorption.size() + s];
            const LeavingTable::Depths& side = above ? medium.above : medium.below;
            for (const Corner& corner : corners) {
                add(sum, share * corner.weight * (1.0F - depth.part), side[depth.low][corner.pair]);
                add(sum, share * corner.weight * depth.part, side[depth.low + 1][corner.pair]);
            }
        }
    }
    return sum;
}

}  // namespace

template <class Real>
Real table_brf(const BasicSlab<Real>& slab, bool above, Real mu0, Real mu, Real cos_scatter) noexcept {
    const auto place = [](Real at, std::size_t nodes) { return between(static_cast<float>(at), nodes); };
    const Real transport = (Real(1) - slab.albedo * slab.g) * slab.optical_depth;
    const Real absorption = TableMedia::absorption(slab.g, slab.albedo);
    const LeavingTable::Node found =
        leaving_terms(shares_of(static_cast<float>(slab.g), static_cast<float>(absorption)), above,
                      place(DepthAxis::place(transport), LeavingTable::kDepths),
                      place(CosineAxis::place(mu0), LeavingTable::kCosines),
                      place(CosineAxis::place(mu), LeavingTable::kCosines));
    const Real cosine = std::clamp(cos_scatter, Real(-1), Real(1));
    const auto modes = azimuth_modes(cosine + (above ? mu0 * mu : -mu0 * mu), mu0, mu);
    constexpr CloudPhase kHg = CloudPhase::kHenyeyGreenstein;
    const Real twice = cloud_phase(kHg, slab.g * slab.g, cosine);
    Real left = static_cast<Real>(found[3]) * twice;
    for (std::size_t mode = 0; mode < modes.size(); ++mode)
        left += static_cast<Real>(found[mode]) * modes[mode];
    left *= caught(slab.optical_depth, mu0, mu) * (above ? Real(1) : passed_share(transport, absorption));
    const auto orders = first_orders(above, slab.optical_depth, mu0, mu, slab.albedo);
    return std::max(Real(0), left + orders[0] * cloud_phase(kHg, slab.g, cosine) + orders[1] * twice);
}

template <class Real>
SlabFluxes<Real> table_fluxes(const BasicSlab<Real>& slab, Real mu0) noexcept {
    const Real transport = (Real(1) - slab.albedo * slab.g) * slab.optical_depth;
    const Real absorption = TableMedia::absorption(slab.g, slab.albedo);
    const Shares shares = shares_of(static_cast<float>(slab.g), static_cast<float>(absorption));
    const Between depth = between(static_cast<float>(DepthAxis::place(transport)), LeavingTable::kDepths);
    const Between source = between(static_cast<float>(CosineAxis::place(mu0)), LeavingTable::kCosines);
    std::array<float, 2> found{};
    for (std::size_t g = 0; g < shares.by_g.size(); ++g) {
        for (std::size_t s = 0; s < shares.by_absorption.size(); ++s) {
            const float share = shares.by_g[g] * shares.by_absorption[s];
            if (share == 0.0F) continue;
            const LeavingTable::Fluxes& fluxes = kLeavingTables[g * shares.by_absorption.size() + s].fluxes;
            for (std::size_t side = 0; side < found.size(); ++side) {
                const auto at = [&](std::size_t row) {
                    return (1.0F - source.part) * fluxes[row][source.low][side] +
                           source.part * fluxes[row][source.low + 1][side];
                };
                found[side] += share * ((1.0F - depth.part) * at(depth.low) + depth.part * at(depth.low + 1));
            }
        }
    }
    const Real slant = slab.optical_depth / mu0;
    const Real direct = std::exp(-slant);
    const Real lost = -std::expm1(-slant);
    const Real down = lost * passed_share(transport, absorption) * static_cast<Real>(found[1]);
    const Real up = lost * static_cast<Real>(found[0]);
    // Interpolated apart, they are made to keep the energy.
    const Real whole = lost / std::max(up + down, Real(1e-30));
    const Real keep = absorption > Real(0) ? std::min(Real(1), whole) : lost > Real(0) ? whole : Real(0);
    return {direct + keep * down, keep * up, direct};
}

InsideTable::Node inside_terms(const InsideView& view, float above, float below, float mu0) noexcept {
    const Between depth = between(DepthAxis::place(above + below), InsideTable::kDepths);
    const Between place = between(PlaceAxis::place(above, below), InsideTable::kPlaces);
    const Between source = between(CosineAxis::place(mu0), InsideTable::kSources);
    InsideTable::Node sum{};
    for (std::size_t medium = 0; medium < view.by_g.size(); ++medium) {
        if (view.by_g[medium] == 0.0F) continue;
        for (std::size_t corner = 0; corner < 16; ++corner) {
            const auto side = [corner](std::size_t bit) { return (corner >> bit) & 1U; };
            const auto weight = [&](const Between& axis, std::size_t bit) {
                return side(bit) != 0 ? axis.part : 1.0F - axis.part;
            };
            add(sum,
                view.by_g[medium] * weight(view.cosine, 0) * weight(source, 1) * weight(depth, 2) *
                    weight(place, 3),
                kInsideTables[medium][view.cosine.low + side(0)][source.low + side(1)][depth.low + side(2)]
                             [place.low + side(3)]);
        }
    }
    return sum;
}

InsideView inside_view(float g, float mu_view) noexcept {
    return {shares_of(g, 0.0F).by_g, between(CosineAxis::signed_place(mu_view), InsideTable::kViews)};
}

template SlabFluxes<float> table_fluxes(const Slab&, float) noexcept;
template SlabFluxes<double> table_fluxes(const Slab64&, double) noexcept;
template float table_brf(const Slab&, bool, float, float, float) noexcept;
template double table_brf(const Slab64&, bool, double, double, double) noexcept;

}  // namespace skyig::render::cloud
