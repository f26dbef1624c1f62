#include "render/cloud/field/inside_light.h"

#include <algorithm>
#include <cmath>

#include "render/cloud/slab_lookup.h"

namespace skyig::render::cloud::field {

static_assert(kSlabViews == InsideTable::kViews && kSlabSources == InsideTable::kSources &&
              kSlabDepths == InsideTable::kDepths && kSlabPlaces == InsideTable::kPlaces);

namespace {

std::vector<InsideTable::Node> mixed(float g) {
    const InsideView view = inside_view(g, 0.0F);
    std::vector<InsideTable::Node> nodes;
    nodes.reserve(InsideTable::kViews * InsideTable::kSources * InsideTable::kDepths * InsideTable::kPlaces);
    for (std::size_t v = 0; v < InsideTable::kViews; ++v) {
        for (std::size_t s = 0; s < InsideTable::kSources; ++s) {
            for (std::size_t d = 0; d < InsideTable::kDepths; ++d) {
                for (std::size_t p = 0; p < InsideTable::kPlaces; ++p) {
                    InsideTable::Node& node = nodes.emplace_back();
                    for (std::size_t m = 0; m < view.by_g.size(); ++m) {
                        for (std::size_t term = 0; term < node.size(); ++term)
                            node[term] += view.by_g[m] * kInsideTables[m][v][s][d][p][term];
                    }
                }
            }
        }
    }
    return nodes;
}

}  // namespace

InsideLight::InsideLight(float g) {
    constexpr float kMost = 65535.0F;
    const std::vector<InsideTable::Node> nodes = mixed(g);
    for (std::size_t term = 0; term < 4; ++term) {
        const auto [low, high] = std::minmax_element(
            nodes.begin(), nodes.end(), [term](const auto& a, const auto& b) { return a[term] < b[term]; });
        told_.low[term] = (*low)[term];
        told_.step[term] = std::max((*high)[term] - (*low)[term], 1e-12F) / kMost;
    }
    entries_.reserve(2 * nodes.size());
    for (const InsideTable::Node& node : nodes) {
        const auto part = [&](std::size_t term) {
            return static_cast<std::uint32_t>(std::lround((node[term] - told_.low[term]) / told_.step[term]));
        };
        entries_.push_back(part(0) | part(1) << 16U);
        entries_.push_back(part(2) | part(3) << 16U);
    }
}

SlabNodes InsideLight::nodes() const noexcept {
    SlabNodes nodes = told_;
    nodes.entries = entries_.data();
    return nodes;
}

}  // namespace skyig::render::cloud::field
