// What a weather report makes of the weather: rules of WMO codes where there are such, and stated guesses
// where a report is silent (docs/weather.md).
#pragma once

#include <vector>

#include "config/config.h"
#include "protocol/metar/report.h"

namespace skyig::server {

struct MetarWeather {
    config::Air air;
    /// Heights above the aerodrome. Low ones first within clouds.
    std::vector<config::WeatherLayer> layers;
};

/// \param before  the air as it is; what the report does not tell stays, and a visibility of "10 km or more"
/// stays where it is better
[[nodiscard]] MetarWeather metar_weather(const protocol::metar::Report& report, const config::Air& before);

}  // namespace skyig::server
