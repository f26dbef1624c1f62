#include "server/world/surface_store.h"

#include <algorithm>

#include "server/world/sorted_store.h"

namespace skyig::server::world {
namespace {

using protocol::cigi::MaritimeSurfaceControl;
using protocol::cigi::TerrestrialSurfaceControl;
using protocol::cigi::WaveControl;
using protocol::cigi::WeatherScope;

/// By scope, then region; the region of what is global means nothing.
std::uint64_t area_key(WeatherScope scope, std::uint16_t region_id) noexcept {
    const std::uint64_t region = scope == WeatherScope::kGlobal ? 0U : region_id;
    return (static_cast<std::uint64_t>(scope) << 32U) | (region << 16U);
}

std::uint64_t sea_key(const MaritimeSurfaceControl& sea) noexcept {
    return area_key(sea.scope, sea.entity_region_id);
}

std::uint64_t wave_key(const WaveControl& wave) noexcept {
    return area_key(wave.scope, wave.entity_region_id) | wave.wave_id;
}

std::uint64_t condition_key(const TerrestrialSurfaceControl& condition) noexcept {
    return area_key(condition.scope, condition.entity_region_id) | condition.condition_id;
}

/// The items of a sorted list whose keys are from..to.
template <class Item, class Key>
std::span<const Item> between(const std::vector<Item>& items, std::uint64_t from, std::uint64_t to,
                              Key key) noexcept {
    const auto first =
        std::lower_bound(items.begin(), items.end(), from,
                         [key](const Item& item, std::uint64_t value) { return key(item) < value; });
    const auto last = std::upper_bound(
        first, items.end(), to, [key](std::uint64_t value, const Item& item) { return value < key(item); });
    return {items.data() + (first - items.begin()), static_cast<std::size_t>(last - first)};
}

}  // namespace

SurfaceStore::SurfaceStore() {
    seas_.reserve(kMaxSeas);
    waves_.reserve(kMaxWaves);
    conditions_.reserve(kMaxConditions);
}

bool SurfaceStore::set(const MaritimeSurfaceControl& sea) noexcept {
    return store_sorted(seas_, sea, kMaxSeas, sea_key).has_value();
}

bool SurfaceStore::set(const WaveControl& wave) noexcept {
    return store_sorted(waves_, wave, kMaxWaves, wave_key).has_value();
}

bool SurfaceStore::set(const TerrestrialSurfaceControl& condition) noexcept {
    return store_sorted(conditions_, condition, kMaxConditions, condition_key).has_value();
}

void SurfaceStore::forget_region(std::uint16_t region_id) noexcept {
    const auto in_region = [region_id](const auto& item) {
        return item.scope == WeatherScope::kRegional && item.entity_region_id == region_id;
    };
    std::erase_if(seas_, in_region);
    std::erase_if(waves_, in_region);
    std::erase_if(conditions_, in_region);
}

void SurfaceStore::clear() noexcept {
    seas_.clear();
    waves_.clear();
    conditions_.clear();
}

const MaritimeSurfaceControl* SurfaceStore::sea(WeatherScope scope, std::uint16_t region_id) const noexcept {
    const std::uint64_t key = area_key(scope, region_id);
    const auto found = between(seas_, key, key, sea_key);
    return found.empty() || !found.front().enable ? nullptr : found.data();
}

std::span<const WaveControl> SurfaceStore::waves(WeatherScope scope, std::uint16_t region_id) const noexcept {
    const std::uint64_t key = area_key(scope, region_id);
    return between(waves_, key, key | 0xFFU, wave_key);
}

std::span<const TerrestrialSurfaceControl> SurfaceStore::conditions(WeatherScope scope,
                                                                    std::uint16_t region_id) const noexcept {
    const std::uint64_t key = area_key(scope, region_id);
    return between(conditions_, key, key | 0xFFFFU, condition_key);
}

}  // namespace skyig::server::world
