#include "server/weather/gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "render/weather_area.h"

namespace skyig::server::weather {
namespace {

using protocol::cigi::EnvRegionControl;
using protocol::cigi::RegionState;
using protocol::cigi::WeatherControl;
using protocol::cigi::WeatherScope;

constexpr glm::dvec2 kEye{0.0};

GroundArea area_of(const EnvRegionControl& region) noexcept {
    GroundArea area;
    area.centre = {region.latitude, region.longitude, 0.0};
    area.rotation_rad = static_cast<double>(region.rotation) * std::numbers::pi / 180.0;
    area.corner_radius_m = static_cast<double>(region.corner_radius);
    area.half_size_m = glm::dvec2{region.size_x, region.size_y} / 2.0 - area.corner_radius_m;
    area.perimeter_m = static_cast<double>(region.transition_perimeter);
    return area;
}

double beyond_m(const render::WeatherArea& area) noexcept {
    return std::max(render::area_distance_m(area, kEye) - area.perimeter_m, 0.0);
}

bool nearer(const ToldLayer& a, const ToldLayer& b) noexcept {
    return std::tie(a.distance_m, a.key.place, a.key.kind) < std::tie(b.distance_m, b.key.place, b.key.kind);
}

/// Part of the layer's height between the two heights.
double part_between(const LayerState& layer, double base_m, double top_m) noexcept {
    const double from_m = std::max(layer.base_m, base_m);
    const double to_m = std::min(layer.base_m + layer.thickness_m, top_m);
    return std::max(to_m - from_m, 0.0) / layer.thickness_m;
}

}  // namespace

Gatherer::Gatherer() {
    regions_.reserve(world::WeatherStore::kMaxRegions);
    covers_.reserve(world::WeatherStore::kMaxLayers);
    layers_.reserve(kMost + 1);
}

std::span<const ToldLayer> Gatherer::gather(const world::World& world, const EyePlane& plane,
                                            const Meaning& meaning) {
    layers_.clear();
    left_out_ = 0;
    find_regions(world, plane);
    for (const WeatherControl& control : world.weather().layers_of(WeatherScope::kGlobal, 0)) {
        if (!control.weather_enable) continue;
        if (const auto layer = told_layer(control, meaning)) add(*layer);
    }
    for (Region& region : regions_)
        add_regional(world, region, meaning);
    add_entities(world, plane, meaning);
    for (ToldLayer& layer : layers_)
        layer.uncovered = uncovered(layer);
    return layers_;
}

void Gatherer::add_regional(const world::World& world, Region& region, const Meaning& meaning) {
    region.first_cover = covers_.size();
    for (const WeatherControl& control : world.weather().layers_of(WeatherScope::kRegional, region.id)) {
        if (!control.weather_enable) continue;
        auto layer = told_layer(control, meaning);
        if (!layer) continue;
        layer->area = region.area;
        layer->distance_m = region.distance_m;
        add(*layer);
        const LayerState& state = layer->state;
        if (region.weight > 0.0)
            covers_.push_back({layer->key.family, state.base_m, state.base_m + state.thickness_m});
    }
    region.cover_count = covers_.size() - region.first_cover;
}

void Gatherer::find_regions(const world::World& world, const EyePlane& plane) {
    regions_.clear();
    covers_.clear();
    const auto regions = world.weather().regions();
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const EnvRegionControl& told = regions[i];
        if (told.region_state != RegionState::kActive) continue;
        if (world.weather().layers_of(WeatherScope::kRegional, told.region_id).empty()) continue;
        Region region{told.region_id, told.merge_weather, world.weather().regions_sent()[i], area_of(told)};
        const render::WeatherArea placed = plane.place(region.area);
        region.distance_m = beyond_m(placed);
        if (region.distance_m > kReach_m) continue;
        region.weight = render::area_weight(placed, kEye);
        regions_.push_back(region);
    }
}

void Gatherer::add_entities(const world::World& world, const EyePlane& plane, const Meaning& meaning) {
    for (const WeatherControl& control : world.weather().carried()) {
        if (!control.weather_enable) continue;
        const auto carrier = world.entity_pose(control.entity_region_id);
        if (!carrier) continue;
        auto layer = told_layer(control, meaning, carrier->position.height_m);
        if (!layer) continue;
        layer->area = GroundArea{};
        layer->area->centre = carrier->position;
        layer->area->perimeter_m = static_cast<double>(control.transition_band);
        layer->distance_m = beyond_m(plane.place(*layer->area));
        if (layer->distance_m <= kReach_m) add(*layer);
    }
}

double Gatherer::uncovered(const ToldLayer& layer) const noexcept {
    const WeatherScope scope = scope_of(layer.key);
    // Weather of entities lies over all other.
    if (scope == WeatherScope::kEntity) return 1.0;
    std::uint64_t sent = 0;
    if (scope == WeatherScope::kRegional) {
        const auto id = static_cast<std::uint16_t>(layer.key.place >> 8U);
        const auto own =
            std::lower_bound(regions_.begin(), regions_.end(), id,
                             [](const Region& region, std::uint16_t key) { return region.id < key; });
        sent = own->sent;
    }
    double left = 1.0;
    for (const Region& region : regions_) {
        if (region.weight <= 0.0 || region.sent <= sent || (sent > 0 && region.merges)) continue;
        double covered = 0.0;
        for (std::size_t i = region.first_cover; i < region.first_cover + region.cover_count; ++i) {
            const Cover& cover = covers_[i];
            if (cover.family == layer.key.family)
                covered += part_between(layer.state, cover.base_m, cover.top_m);
        }
        left *= 1.0 - region.weight * std::min(covered, 1.0);
    }
    return left;
}

void Gatherer::add(const ToldLayer& layer) noexcept {
    if (layers_.size() == kMost && !nearer(layer, layers_.back())) {
        ++left_out_;
        return;
    }
    layers_.insert(std::upper_bound(layers_.begin(), layers_.end(), layer, nearer), layer);
    if (layers_.size() <= kMost) return;
    layers_.pop_back();
    ++left_out_;
}

}  // namespace skyig::server::weather
