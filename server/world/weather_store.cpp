#include "server/world/weather_store.h"

#include <algorithm>

#include "server/world/sorted_store.h"

namespace skyig::server::world {
namespace {

using protocol::cigi::EnvRegionControl;
using protocol::cigi::RegionState;
using protocol::cigi::WeatherControl;
using protocol::cigi::WeatherScope;

/// Orders by scope, then region or entity, then layer. The id of a global layer means nothing, and the layer
/// id of weather that hangs on an entity neither.
std::uint32_t key_of(const WeatherControl& layer) noexcept {
    const bool global = layer.scope == WeatherScope::kGlobal;
    const bool entity = layer.scope == WeatherScope::kEntity;
    return (static_cast<std::uint32_t>(layer.scope) << 24U) |
           (static_cast<std::uint32_t>(global ? 0 : layer.entity_region_id) << 8U) |
           static_cast<std::uint32_t>(entity ? 0 : layer.layer_id);
}

std::uint16_t id_of(const EnvRegionControl& region) noexcept {
    return region.region_id;
}

bool by_key(const WeatherControl& a, const WeatherControl& b) noexcept {
    return key_of(a) < key_of(b);
}

bool by_id(const EnvRegionControl& a, const EnvRegionControl& b) noexcept {
    return a.region_id < b.region_id;
}

WeatherControl probe(WeatherScope scope, std::uint16_t region_id, std::uint8_t layer_id) noexcept {
    WeatherControl layer;
    layer.scope = scope;
    layer.entity_region_id = region_id;
    layer.layer_id = layer_id;
    return layer;
}

}  // namespace

WeatherStore::WeatherStore() {
    layers_.reserve(kMaxLayers);
    regions_.reserve(kMaxRegions);
    regions_sent_.reserve(kMaxRegions);
}

bool WeatherStore::set(const WeatherControl& layer) noexcept {
    return store_sorted(layers_, layer, kMaxLayers, key_of).has_value();
}

bool WeatherStore::set(const EnvRegionControl& region) noexcept {
    if (region.region_state != RegionState::kDestroyed) {
        const auto stored = store_sorted(regions_, region, kMaxRegions, id_of);
        if (!stored) return false;
        const auto at = regions_sent_.begin() + static_cast<std::ptrdiff_t>(stored->index);
        if (stored->added) {
            regions_sent_.insert(at, ++sent_);
        } else {
            *at = ++sent_;
        }
        return true;
    }
    const auto place = std::lower_bound(regions_.begin(), regions_.end(), region, by_id);
    if (place != regions_.end() && place->region_id == region.region_id) {
        regions_sent_.erase(regions_sent_.begin() + (place - regions_.begin()));
        regions_.erase(place);
    }
    forget(WeatherScope::kRegional, region.region_id);
    return true;
}

void WeatherStore::forget_entity(std::uint16_t entity_id) noexcept {
    forget(WeatherScope::kEntity, entity_id);
}

void WeatherStore::forget(WeatherScope scope, std::uint16_t id) noexcept {
    // They stand together: found, not searched for.
    const std::span<const WeatherControl> gone = layers_of(scope, id);
    const auto first = layers_.begin() + (gone.data() - layers_.data());
    layers_.erase(first, first + static_cast<std::ptrdiff_t>(gone.size()));
}

void WeatherStore::clear() noexcept {
    layers_.clear();
    regions_.clear();
    regions_sent_.clear();
}

std::span<const WeatherControl> WeatherStore::layers_of(WeatherScope scope,
                                                        std::uint16_t region_id) const noexcept {
    const auto first = std::lower_bound(layers_.begin(), layers_.end(), probe(scope, region_id, 0), by_key);
    const auto last = std::upper_bound(first, layers_.end(), probe(scope, region_id, 255), by_key);
    return {layers_.data() + (first - layers_.begin()), static_cast<std::size_t>(last - first)};
}

std::span<const WeatherControl> WeatherStore::carried() const noexcept {
    const auto first =
        std::lower_bound(layers_.begin(), layers_.end(), probe(WeatherScope::kEntity, 0, 0), by_key);
    return {layers_.data() + (first - layers_.begin()), static_cast<std::size_t>(layers_.end() - first)};
}

bool WeatherStore::enable_layer(WeatherScope scope, std::uint16_t region_id, std::uint8_t layer_id,
                                bool enable) noexcept {
    const WeatherControl wanted = probe(scope, region_id, layer_id);
    const auto place = std::lower_bound(layers_.begin(), layers_.end(), wanted, by_key);
    if (place == layers_.end() || key_of(*place) != key_of(wanted)) return false;
    place->weather_enable = enable;
    return true;
}

bool WeatherStore::enable_region(std::uint16_t region_id, bool enable) noexcept {
    EnvRegionControl wanted;
    wanted.region_id = region_id;
    const auto place = std::lower_bound(regions_.begin(), regions_.end(), wanted, by_id);
    if (place == regions_.end() || place->region_id != region_id) return false;
    place->region_state = enable ? RegionState::kActive : RegionState::kInactive;
    return true;
}

}  // namespace skyig::server::world
