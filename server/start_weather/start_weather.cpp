#include "server/start_weather/start_weather.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/metar/decode.h"
#include "server/start_weather/areas.h"
#include "server/start_weather/layers.h"
#include "server/start_weather/metar_weather.h"

namespace skyig::server {

StartWeather start_weather(const config::Config& config) {
    const config::Weather& weather = config.weather;
    StartWeather start{config.air, {}, {}};
    std::vector<config::WeatherLayer> layers;
    if (!weather.metar.empty()) {
        MetarWeather reported = metar_weather(protocol::metar::decode(weather.metar), config.air);
        start.air = reported.air;
        layers = std::move(reported.layers);
    }
    layers.insert(layers.end(), weather.layers.begin(), weather.layers.end());
    start.layers = weather_controls(layers, start.air, weather.elevation_m);
    RegionalWeather regional = regional_weather(weather.areas, start.air, weather.elevation_m);
    start.layers.insert(start.layers.end(), regional.layers.begin(), regional.layers.end());
    start.regions = std::move(regional.regions);
    return start;
}

std::string metar_fault(const config::Config& config, const std::string& settings_file) {
    if (config.weather.metar.empty()) return {};
    const protocol::metar::Report report = protocol::metar::decode(config.weather.metar);
    if (report.valid()) return {};
    return config::to_text(
        {settings_file, 0, 0, "weather.metar", protocol::metar::describe(report.problems.front())});
}

std::string metar_left_out(const config::Config& config, const std::string& settings_file) {
    if (config.weather.metar.empty()) return {};
    const protocol::metar::Report report = protocol::metar::decode(config.weather.metar);
    if (report.unparsed.empty()) return {};
    std::string groups;
    for (const std::string& group : report.unparsed)
        groups += fmt::format("{}'{}'", groups.empty() ? "" : ", ", group);
    return config::to_text(
        {settings_file, 0, 0, "weather.metar", fmt::format("{}: of no known kind, left out", groups)});
}

}  // namespace skyig::server
