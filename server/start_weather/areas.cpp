#include "server/start_weather/areas.h"

#include <algorithm>
#include <cmath>

#include "server/start_weather/layers.h"

namespace skyig::server {
namespace {

using protocol::cigi::EnvRegionControl;
using protocol::cigi::WeatherControl;

/// The first region id that no area names and no region has.
int free_region_id(std::span<const config::WeatherArea> areas,
                   std::span<const EnvRegionControl> made) noexcept {
    const auto taken = [&](int id) {
        return std::any_of(areas.begin(), areas.end(), [id](const auto& area) { return area.id == id; }) ||
               std::any_of(made.begin(), made.end(),
                           [id](const auto& region) { return region.region_id == id; });
    };
    int id = 1;
    while (taken(id))
        ++id;
    return id;
}

EnvRegionControl region_of(const config::WeatherArea& area, int id) noexcept {
    EnvRegionControl made;
    made.region_id = static_cast<std::uint16_t>(id);
    made.region_state = protocol::cigi::RegionState::kActive;
    made.merge_weather = area.merge;
    made.latitude = area.latitude_deg;
    made.longitude = area.longitude_deg;
    // A region's X is along its rotation; both sizes go from edge to edge.
    made.size_x = static_cast<float>(2.0 * area.half_length_m);
    made.size_y = static_cast<float>(2.0 * area.half_width_m);
    made.corner_radius = static_cast<float>(area.corner_radius_m);
    made.rotation = static_cast<float>(std::remainder(area.rotation_deg, 360.0));
    made.transition_perimeter = static_cast<float>(area.perimeter_m);
    return made;
}

}  // namespace

RegionalWeather regional_weather(std::span<const config::WeatherArea> areas, const config::Air& air,
                                 double elevation_m) {
    RegionalWeather made;
    for (const config::WeatherArea& area : areas) {
        const EnvRegionControl region =
            region_of(area, area.id ? *area.id : free_region_id(areas, made.regions));
        for (WeatherControl& layer : weather_controls(area.layers, air, elevation_m)) {
            layer.scope = protocol::cigi::WeatherScope::kRegional;
            layer.entity_region_id = region.region_id;
            made.layers.push_back(layer);
        }
        made.regions.push_back(region);
    }
    return made;
}

}  // namespace skyig::server
