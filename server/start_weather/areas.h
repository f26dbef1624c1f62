// Areas of the settings as the regions that a host would make for them.
#pragma once

#include <span>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/packets.h"

namespace skyig::server {

struct RegionalWeather {
    /// Active, in the order in which they are to be sent.
    std::vector<protocol::cigi::EnvRegionControl> regions;
    std::vector<protocol::cigi::WeatherControl> layers;
};

[[nodiscard]] RegionalWeather regional_weather(std::span<const config::WeatherArea> areas,
                                               const config::Air& air, double elevation_m);

}  // namespace skyig::server
