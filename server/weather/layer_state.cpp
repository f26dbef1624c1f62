#include "server/weather/layer_state.h"

#include <cmath>

#include "render/weather_ramp.h"

namespace skyig::server::weather {

LayerState mix(const LayerState& from, const LayerState& to, double t) noexcept {
    const auto between = [&](double LayerState::*member) {
        return from.*member == to.*member ? to.*member : std::lerp(from.*member, to.*member, t);
    };
    LayerState mixed;
    mixed.base_m = between(&LayerState::base_m);
    mixed.thickness_m = between(&LayerState::thickness_m);
    mixed.bottom_band_m = between(&LayerState::bottom_band_m);
    mixed.top_band_m = between(&LayerState::top_band_m);
    mixed.coverage = render::between<render::CoverScale>(from.coverage, to.coverage, t);
    mixed.extinction_per_m =
        render::between<render::ExtinctionScale>(from.extinction_per_m, to.extinction_per_m, t);
    mixed.rate_mm_h = between(&LayerState::rate_mm_h);
    mixed.severity = between(&LayerState::severity);
    mixed.bottom_scud = between(&LayerState::bottom_scud);
    mixed.top_scud = between(&LayerState::top_scud);
    mixed.flashes_per_min = between(&LayerState::flashes_per_min);
    return mixed;
}

LayerState nothing_of(Family family, const LayerState& state) noexcept {
    LayerState nothing = state;
    nothing.flashes_per_min = 0.0;
    if (family == Family::kCloud) {
        nothing.coverage = 0.0;
    } else {
        nothing.extinction_per_m = nothing.rate_mm_h = 0.0;
    }
    return nothing;
}

}  // namespace skyig::server::weather
