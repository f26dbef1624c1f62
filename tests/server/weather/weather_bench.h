// A host, its world and the scenes that follow, frame by frame.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "server/from_config.h"
#include "server/scene_builder.h"
#include "tests/server/world/host_bench.h"

namespace skyig::server::weather {

namespace cigi = protocol::cigi;

inline cigi::WeatherControl cloud(std::uint8_t id, cigi::CloudType type, float base_m, float coverage_pct) {
    cigi::WeatherControl layer;
    layer.layer_id = id;
    layer.cloud_type = type;
    layer.weather_enable = true;
    layer.base_elevation = base_m;
    layer.thickness = 500.0F;
    layer.coverage = coverage_pct;
    return layer;
}

inline cigi::WeatherControl in_region(cigi::WeatherControl layer, std::uint16_t region) {
    layer.scope = cigi::WeatherScope::kRegional;
    layer.entity_region_id = region;
    return layer;
}

inline cigi::EnvRegionControl region(std::uint16_t id, double latitude_deg, double longitude_deg,
                                     float size_m, float perimeter_m = 0.0F) {
    cigi::EnvRegionControl made;
    made.region_id = id;
    made.region_state = cigi::RegionState::kActive;
    made.latitude = latitude_deg;
    made.longitude = longitude_deg;
    made.size_x = made.size_y = size_m;
    made.transition_perimeter = perimeter_m;
    return made;
}

struct WeatherBench {
    explicit WeatherBench(const config::Config& config = world::three_channels())
        : host(config),
          scenes(ephemeris::Model::kAlmanac, {}, sky_settings(config.sky), {}, {},
                 weather_settings(config.weather)) {}

    template <class... Packets>
    void send(const Packets&... packets) {
        host.send(world::kHostA, packets...);
    }
    const render::Scene& frame(double step_s = 1.0 / 60.0) {
        host.world.advance(step_s);
        scene = scenes.build(host.world, ++number);
        return scene;
    }
    /// Long enough for every ramp to end.
    const render::Scene& settle() {
        for (int i = 0; i < 12; ++i)
            frame(1.0);
        return scene;
    }
    [[nodiscard]] const render::Weather& weather() const { return scene.weather; }

    world::HostBench host;
    SceneBuilder scenes;
    render::Scene scene;
    std::uint64_t number = 0;
};

}  // namespace skyig::server::weather
