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
    const auto place =
        std::lower_bound(regions_.begin(), regions_.end(), region,
                         [id_of](const auto& a, const auto& b) { return id_of(a) < id_of(b); });
    if (place != regions_.end() && place->region_id == region.region_id) regions_.erase(place);
    // The layers of one region stand together: found, not searched for.
    WeatherControl lowest;
    lowest.scope = WeatherScope::kRegional;
    lowest.entity_region_id = region.region_id;
    lowest.layer_id = 0;
    WeatherControl highest = lowest;
    highest.layer_id = 255;
    const auto by_key = [](const WeatherControl& a, const WeatherControl& b) {
        return key_of(a) < key_of(b);
    };
    layers_.erase(std::lower_bound(layers_.begin(), layers_.end(), lowest, by_key),
                  std::upper_bound(layers_.begin(), layers_.end(), highest, by_key));
    return true;
}

void WeatherStore::clear() noexcept {
    layers_.clear();
    regions_.clear();
}

}  // namespace skyig::server::world
