// Light from the tables of slab_table.h (same folder).
#pragma once

#include "render/cloud/slab_light.h"
#include "render/cloud/slab_table.h"

namespace skyig::render::cloud {

/// slab_brf() by SlabModel::kTable, of a slab in range and cosines off the horizon.
template <class Real>
[[nodiscard]] Real table_brf(const BasicSlab<Real>& slab, bool above, Real mu0, Real mu,
                             Real cos_scatter) noexcept;

/// Scattered light of slab_fluxes(), by their table.
template <class Real>
[[nodiscard]] SlabFluxes<Real> table_fluxes(const BasicSlab<Real>& slab, Real mu0) noexcept;

/// Between two nodes of an axis.
struct Between {
    std::size_t low = 0;
    float part = 0.0F;
};
/// \param place  0..1
[[nodiscard]] inline Between between(float place, std::size_t nodes) noexcept {
    const float scaled = std::clamp(place, 0.0F, 1.0F) * static_cast<float>(nodes - 1);
    const auto low = std::min(static_cast<std::size_t>(scaled), nodes - 2);
    return {low, scaled - static_cast<float>(low)};
}

/// What is the same along a view ray.
struct InsideView {
    std::array<float, TableMedia::kG.size()> by_g{};
    Between cosine;
};
/// \param mu_view  of the light's way, > 0 up
[[nodiscard]] InsideView inside_view(float g, float mu_view) noexcept;

/// Factors of InsideTable, over even_share(), at a point between transport depths, for light from `mu0`.
[[nodiscard]] InsideTable::Node inside_terms(const InsideView& view, float above, float below,
                                             float mu0) noexcept;

}  // namespace skyig::render::cloud
