#include "server/start_weather/layers.h"

#include <algorithm>
#include <cmath>

#include "server/start_weather/precipitation.h"

namespace skyig::server {
namespace {

using config::LayerType;
using protocol::cigi::CloudType;
using protocol::cigi::WeatherControl;

LayerId id_of(LayerType type) noexcept {
    switch (type) {
        case LayerType::kHaze:
            return LayerId::kHaze;
        case LayerType::kSmoke:
            return LayerId::kSmoke;
        case LayerType::kSand:
            return LayerId::kSand;
        case LayerType::kDust:
            return LayerId::kDust;
        case LayerType::kDrizzle:
            return LayerId::kDrizzle;
        case LayerType::kRain:
            return LayerId::kRain;
        case LayerType::kSnow:
            return LayerId::kSnow;
        case LayerType::kSleet:
            return LayerId::kSleet;
        case LayerType::kHail:
            return LayerId::kHail;
        default:
            break;
    }
    return LayerId::kGroundFog;
}

static_assert(static_cast<int>(LayerType::kStratus) - static_cast<int>(LayerType::kAltocumulus) ==
                  static_cast<int>(CloudType::kStratus) - static_cast<int>(CloudType::kAltocumulus),
              "one order of genera in settings and packets");

CloudType cloud_type(LayerType type) noexcept {
    if (!config::is_cloud(type)) return CloudType::kNone;
    return static_cast<CloudType>(static_cast<int>(type) - static_cast<int>(LayerType::kAltocumulus) +
                                  static_cast<int>(CloudType::kAltocumulus));
}

bool has_id(std::span<const WeatherControl> layers, int id) noexcept {
    return std::any_of(layers.begin(), layers.end(),
                       [id](const WeatherControl& l) { return l.layer_id == id; });
}

/// The first cloud id that is free.
int free_cloud_id(std::span<const WeatherControl> layers) noexcept {
    int id = static_cast<int>(LayerId::kCloud1);
    while (id < 255 && has_id(layers, id))
        id = id == static_cast<int>(LayerId::kCloud3) ? static_cast<int>(LayerId::kFirstOwnCloud) : id + 1;
    return id;
}

WeatherControl control_of(const config::WeatherLayer& layer, const config::Air& air, double elevation_m) {
    WeatherControl made;
    made.weather_enable = true;
    made.cloud_type = cloud_type(layer.type);
    made.humidity = static_cast<std::uint8_t>(std::lround(std::clamp(air.humidity_pct, 0.0, 100.0)));
    made.scud_enable = layer.bottom_scud_pct > 0.0;
    made.top_scud_enable = layer.top_scud_pct > 0.0;
    made.scud_frequency = static_cast<float>(layer.bottom_scud_pct);
    made.top_scud_frequency = static_cast<float>(layer.top_scud_pct);
    made.random_lightning = layer.lightning;
    made.severity = static_cast<std::uint8_t>(layer.severity);
    made.air_temperature = static_cast<float>(air.temperature_c);
    made.pressure = static_cast<float>(air.pressure_hpa);
    made.visibility = static_cast<float>(layer.visibility_m);
    made.coverage = static_cast<float>(100.0 * layer.coverage);
    made.base_elevation = static_cast<float>(layer.base_m + elevation_m);
    made.thickness = static_cast<float>(layer.thickness_m);
    made.transition_band = static_cast<float>(layer.bottom_band_m);
    made.top_transition_band = static_cast<float>(layer.top_band_m);
    made.aerosol = static_cast<float>(water_g_m3(layer.rate_mm_h));
    // Without one it goes by whatever wind the air has then.
    made.wind_horizontal = static_cast<float>(layer.wind_m_s.value_or(0.0));
    made.wind_direction = static_cast<float>(layer.wind_m_s ? layer.wind_from_deg : 0.0);
    return made;
}

}  // namespace

double wind_gain(double height_agl_m) noexcept {
    return std::pow(std::clamp(height_agl_m, 10.0, 300.0) / 10.0, 0.14);
}

std::vector<WeatherControl> weather_controls(std::span<const config::WeatherLayer> layers,
                                             const config::Air& air, double elevation_m) {
    std::vector<WeatherControl> made;
    for (const config::WeatherLayer& layer : layers) {
        WeatherControl control = control_of(layer, air, elevation_m);
        const int id = config::is_cloud(layer.type) ? layer.id.value_or(free_cloud_id(made))
                                                    : static_cast<int>(id_of(layer.type));
        control.layer_id = static_cast<std::uint8_t>(id);
        std::erase_if(made, [id](const WeatherControl& before) { return before.layer_id == id; });
        made.push_back(control);
    }
    return made;
}

}  // namespace skyig::server
