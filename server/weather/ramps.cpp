#include "server/weather/ramps.h"

#include <algorithm>
#include <cmath>

namespace skyig::server::weather {

void Glide::aim(double to, double since_s, double transition_s) noexcept {
    if (to == to_) return;
    from_ = at(since_s, transition_s);
    to_ = to;
    since_s_ = since_s;
}

double Glide::at(double time_s, double transition_s) const noexcept {
    return settled(time_s, transition_s) ? to_ : std::lerp(from_, to_, (time_s - since_s_) / transition_s);
}

Ramps::Ramps(double transition_s) : transition_s_(transition_s) {
    shown_.reserve(kMost);
}

void Ramps::advance(std::span<const ToldLayer> told, double time_s, bool at_once) noexcept {
    const bool now = at_once || transition_s_ <= 0.0;
    for (ShownLayer& layer : shown_)
        layer.ends = true;
    for (const ToldLayer& layer : told)
        tell(layer);
    for (ShownLayer& layer : shown_)
        move(layer, time_s, time_s - time_s_, now);
    forget_ended(time_s, now);
    time_s_ = time_s;
}

void Ramps::tell(const ToldLayer& told) noexcept {
    const auto found = std::find_if(shown_.begin(), shown_.end(),
                                    [&](const ShownLayer& layer) { return layer.told.key == told.key; });
    if (found == shown_.end()) {
        if (shown_.size() == kMost) return;
        const LayerState nothing = nothing_of(told.key.family, told.state);
        shown_.push_back(
            {told, nothing, told.uncovered, told.area, nothing, time_s_, told.area, time_s_, false});
        return;
    }
    tell_area(*found, told);
    if (found->told.state != told.state) {
        found->from = found->state;
        found->since_s = time_s_;
    }
    found->told = told;
    found->ends = false;
}

void Ramps::tell_area(ShownLayer& layer, const ToldLayer& told) const noexcept {
    const bool carried = scope_of(told.key) == protocol::cigi::WeatherScope::kEntity;
    if (carried || !told.area || !layer.area) {
        layer.area = layer.from_area = told.area;
    } else if (told.area != layer.told.area) {
        layer.from_area = layer.area;
        layer.area_since_s = time_s_;
    }
}

void Ramps::move(ShownLayer& layer, double time_s, double step_s, bool at_once) const noexcept {
    if (layer.ends) {
        const LayerState nothing = nothing_of(layer.told.key.family, layer.told.state);
        if (layer.told.state != nothing) {
            layer.from = layer.state;
            layer.since_s = time_s_;
            layer.told.state = nothing;
        }
    }
    if (at_once) {
        layer.state = layer.from = layer.told.state;
        layer.since_s = time_s;
        layer.uncovered = layer.told.uncovered;
        layer.area = layer.from_area = layer.told.area;
        return;
    }
    const double part = std::clamp((time_s - layer.since_s) / transition_s_, 0.0, 1.0);
    layer.state = mix(layer.from, layer.told.state, part);
    if (layer.from_area && layer.told.area) {
        const double of_area = std::clamp((time_s - layer.area_since_s) / transition_s_, 0.0, 1.0);
        layer.area = mix(*layer.from_area, *layer.told.area, of_area);
    }
    const double most = step_s / transition_s_;
    layer.uncovered += std::clamp(layer.told.uncovered - layer.uncovered, -most, most);
}

void Ramps::forget_ended(double time_s, bool at_once) noexcept {
    std::erase_if(shown_, [&](const ShownLayer& layer) {
        return layer.ends && (at_once || time_s >= layer.since_s + transition_s_);
    });
}

}  // namespace skyig::server::weather
