// The weather that an instructor asks for, as values that can be edited; as JSON for pages and files, and as
// the packets that say it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/message.h"
#include "protocol/result.h"

namespace skyig::clients::instructor {

struct Setting {
    config::Air air;
    /// Heights above the site's elevation. Clouds have an id each.
    std::vector<config::WeatherLayer> layers;
    /// Of the ground, 0..100.
    double snow_pct = 0.0;
};

/// Gives the clouds that have none the next ids that are free, as the daemon does with its own settings; of
/// several of one id, or several of one type that is no cloud, the last stays.
void number_layers(Setting& setting);

[[nodiscard]] nlohmann::ordered_json to_json(const Setting& setting);
/// Every member in the ranges of docs/weather.md; what is left out is as in config::Air and
/// config::WeatherLayer. The error is one line that names the member: "layers[2].top_m is 10; it must be
/// above base_m".
[[nodiscard]] protocol::Result<Setting, std::string> setting_from_json(const nlohmann::ordered_json& json);

/// A preset that is compiled in. \return nothing for any other name
[[nodiscard]] std::optional<Setting> preset_setting(std::string_view name);
/// The first line of its file: "Thunderstorm: dark base, lightning, heavy rain."
[[nodiscard]] std::string preset_title(std::string_view name);

/// What a daemon's /status tells under "world": global layers that are on. Without it the default.
[[nodiscard]] Setting setting_from_status(const nlohmann::ordered_json& world);

/// What the layers' heights count from at the daemon, by its "world".
[[nodiscard]] double elevation_of(const nlohmann::ordered_json& world);

/// Adds Atmosphere Control, Weather Control of each layer and the snow; global layers of the daemon's "world"
/// that the setting has not are switched off. False if the message has no room for all.
[[nodiscard]] bool add_packets(protocol::cigi::MessageWriter& writer, const Setting& setting,
                               double elevation_m, const nlohmann::ordered_json& world);

/// Whether a daemon's "world" tells this air and these layers, to the precision of a packet.
[[nodiscard]] bool is_shown(const Setting& setting, const nlohmann::ordered_json& world);

}  // namespace skyig::clients::instructor
