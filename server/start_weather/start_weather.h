// The weather that the settings describe: at start-up, and again each time a host goes into Standby.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/packets.h"

namespace skyig::server {

struct StartWeather {
    config::Air air;
    /// As a host would tell them: enabled, the global ones by layer id, then those of the regions.
    std::vector<protocol::cigi::WeatherControl> layers;
    /// To be sent in this order.
    std::vector<protocol::cigi::EnvRegionControl> regions;
};

/// The settings' air, layers and areas, with what their weather report says in its place and beside them. Of
/// a report that is wrong in part the rest counts.
[[nodiscard]] StartWeather start_weather(const config::Config& config);

/// What is wrong with the settings' weather report, in a line that names the key; empty: nothing.
[[nodiscard]] std::string metar_fault(const config::Config& config, const std::string& settings_file);

/// Which groups of the report are of no known kind and so left out, in a line that names the key; empty:
/// none.
[[nodiscard]] std::string metar_left_out(const config::Config& config, const std::string& settings_file);

}  // namespace skyig::server
