#include "clients/skyig/metar/state.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "server/start_weather/metar_weather.h"

namespace skyig::clients::metar {
namespace {

nlohmann::ordered_json layer_json(const config::WeatherLayer& layer, double elevation_m) {
    nlohmann::ordered_json json;
    json["type"] = config::kLayerTypeNames[static_cast<std::size_t>(layer.type)];
    json["base_m"] = layer.base_m + elevation_m;
    json["top_m"] = layer.base_m + layer.thickness_m + elevation_m;
    json["coverage_pct"] = 100.0 * layer.coverage;
    if (layer.visibility_m > 0.0) json["visibility_m"] = layer.visibility_m;
    if (layer.rate_mm_h > 0.0) json["rate_mm_h"] = layer.rate_mm_h;
    if (config::is_cloud(layer.type)) json["lightning"] = layer.lightning;
    return json;
}

}  // namespace

std::string state_json(const protocol::metar::Report& report, double elevation_m) {
    const server::MetarWeather weather = server::metar_weather(report, {});
    const config::Air& air = weather.air;
    nlohmann::ordered_json json;
    json["station"] = report.station;
    json["air"] = {{"visibility_m", air.visibility_m},
                   {"extinction_per_m", -std::log(air.visibility_contrast) / air.visibility_m},
                   {"temperature_c", air.temperature_c},
                   {"pressure_hpa", air.pressure_hpa},
                   {"humidity_pct", air.humidity_pct},
                   {"wind_m_s", air.wind_m_s},
                   {"wind_from_deg", air.wind_from_deg}};
    json["layers"] = nlohmann::ordered_json::array();
    for (const config::WeatherLayer& layer : weather.layers)
        json["layers"].push_back(layer_json(layer, elevation_m));
    return json.dump();
}

}  // namespace skyig::clients::metar
