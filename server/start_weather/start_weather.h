// The weather that the settings describe: at start-up, and again each time a host goes into Standby.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/packets.h"

namespace skyig::server {

struct StartWeather {
    config::Air air;
    /// As a host would tell them: global, enabled, by layer id.
    std::vector<protocol::cigi::WeatherControl> layers;
};

/// The settings' air and layers, with what their weather report says in its place and beside them. Of a
/// report that is wrong in part the rest counts.
[[nodiscard]] StartWeather start_weather(const config::Config& config);

/// What is wrong with the settings' weather report, in a line that names the key; empty: nothing.
[[nodiscard]] std::string metar_fault(const config::Config& config, const std::string& settings_file);

}  // namespace skyig::server
