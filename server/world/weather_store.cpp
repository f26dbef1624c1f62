#include "server/world/weather_store.h"

#include <algorithm>

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

/// Puts `item` at its place in a sorted list that never grows beyond what it has reserved.
template <class Item, class Key>
bool store(std::vector<Item>& items, const Item& item, std::size_t most, Key key) noexcept {
    const auto place = std::lower_bound(items.begin(), items.end(), item,
                                        [key](const Item& a, const Item& b) { return key(a) < key(b); });
    if (place != items.end() && key(*place) == key(item)) {
        *place = item;
        return true;
    }
    if (items.size() >= most) return false;
    items.insert(place, item);
    return true;
}

}  // namespace

WeatherStore::WeatherStore() {
    layers_.reserve(kMaxLayers);
    regions_.reserve(kMaxRegions);
}

bool WeatherStore::set(const WeatherControl& layer) noexcept {
    return store(layers_, layer, kMaxLayers, key_of);
}

bool WeatherStore::set(const EnvRegionControl& region) noexcept {
    const auto id_of = [](const EnvRegionControl& item) { return item.region_id; };
    if (region.region_state != RegionState::kDestroyed) return store(regions_, region, kMaxRegions, id_of);
    std::erase_if(regions_, [&](const EnvRegionControl& item) { return item.region_id == region.region_id; });
    std::erase_if(layers_, [&](const WeatherControl& layer) {
        return layer.scope == WeatherScope::kRegional && layer.entity_region_id == region.region_id;
    });
    return true;
}

void WeatherStore::clear() noexcept {
    layers_.clear();
    regions_.clear();
}

}  // namespace skyig::server::world
