#include "clients/instructor/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "config/presets.h"
#include "server/start_weather/layers.h"
#include "server/start_weather/precipitation.h"

namespace skyig::clients::instructor {

namespace cigi = protocol::cigi;
using Json = nlohmann::ordered_json;
using config::LayerType;
using config::WeatherLayer;

namespace {

constexpr double kHighest_m = 30'000.0;
constexpr double kLowest_m = -1'000.0;
/// CIGI leaves it to the image generator; docs/protocols.md.
constexpr std::uint16_t kSnowCondition = 1;

/// Reads members of one object and keeps the first fault.
class MemberReader {
  public:
    MemberReader(const Json& json, std::string path, std::string& fault)
        : json_(json), path_(std::move(path)), fault_(fault) {}

    void number(const char* key, double low, double high, double& value) {
        const auto found = json_.find(key);
        if (found == json_.end() || !fault_.empty()) return;
        const double read =
            found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
        if (read >= low && read <= high) {
            value = read;
        } else {
            fault_ =
                fmt::format("{}.{} is {}; it must be a number, {}..{}", path_, key, found->dump(), low, high);
        }
    }
    void flag(const char* key, bool& value) {
        const auto found = json_.find(key);
        if (found == json_.end() || !fault_.empty()) return;
        if (found->is_boolean()) {
            value = found->get<bool>();
        } else {
            fault_ = fmt::format("{}.{} is {}; it must be true or false", path_, key, found->dump());
        }
    }

  private:
    const Json& json_;
    std::string path_;
    std::string& fault_;
};

std::string_view name_of(LayerType type) noexcept {
    return config::kLayerTypeNames[static_cast<std::size_t>(type)];
}

std::optional<LayerType> type_named(std::string_view name) noexcept {
    const auto* const found = std::find(config::kLayerTypeNames.begin(), config::kLayerTypeNames.end(), name);
    if (found == config::kLayerTypeNames.end()) return std::nullopt;
    return static_cast<LayerType>(found - config::kLayerTypeNames.begin());
}

Json layer_json(const WeatherLayer& layer) {
    Json json{{"type", name_of(layer.type)},
              {"base_m", layer.base_m},
              {"top_m", layer.base_m + layer.thickness_m},
              {"bottom_band_m", layer.bottom_band_m},
              {"top_band_m", layer.top_band_m},
              {"coverage", layer.coverage},
              {"visibility_m", layer.visibility_m},
              {"rate_mm_h", layer.rate_mm_h},
              {"severity", layer.severity},
              {"bottom_scud_pct", layer.bottom_scud_pct},
              {"top_scud_pct", layer.top_scud_pct},
              {"lightning", layer.lightning}};
    if (layer.id) json["id"] = *layer.id;
    if (layer.wind_m_s) {
        json["wind_m_s"] = *layer.wind_m_s;
        json["wind_from_deg"] = layer.wind_from_deg;
    }
    return json;
}

void read_wind(const Json& json, MemberReader& members, WeatherLayer& layer) {
    if (!json.contains("wind_m_s")) return;
    double wind_m_s = 0.0;
    members.number("wind_m_s", 0.0, 150.0, wind_m_s);
    members.number("wind_from_deg", -360.0, 360.0, layer.wind_from_deg);
    layer.wind_m_s = wind_m_s;
}

WeatherLayer layer_from_json(const Json& json, const std::string& path, std::string& fault) {
    WeatherLayer layer;
    if (!fault.empty()) return layer;
    const Json type = json.is_object() ? json.value("type", Json()) : Json();
    const auto named = type.is_string() ? type_named(type.get<std::string>()) : std::nullopt;
    if (!named) {
        fault =
            fmt::format("{}.type is {}; it must be a layer's type such as \"cumulus\"", path, type.dump());
        return layer;
    }
    layer.type = *named;
    MemberReader members(json, path, fault);
    double top_m = kHighest_m;
    double id = 0.0;
    double severity = 0.0;
    members.number("base_m", kLowest_m, kHighest_m, layer.base_m);
    members.number("top_m", kLowest_m, kHighest_m, top_m);
    members.number("bottom_band_m", 0.0, kHighest_m, layer.bottom_band_m);
    members.number("top_band_m", 0.0, kHighest_m, layer.top_band_m);
    members.number("coverage", 0.0, 1.0, layer.coverage);
    members.number("visibility_m", 0.0, 400'000.0, layer.visibility_m);
    members.number("rate_mm_h", 0.0, 300.0, layer.rate_mm_h);
    members.number("severity", 0.0, 5.0, severity);
    members.number("bottom_scud_pct", 0.0, 100.0, layer.bottom_scud_pct);
    members.number("top_scud_pct", 0.0, 100.0, layer.top_scud_pct);
    members.number("id", 1.0, 255.0, id);
    members.flag("lightning", layer.lightning);
    read_wind(json, members, layer);
    layer.severity = static_cast<int>(severity);
    layer.thickness_m = top_m - layer.base_m;
    if (id >= 1.0 && config::is_cloud(layer.type)) layer.id = static_cast<int>(id);
    if (fault.empty() && layer.thickness_m <= 0.0)
        fault = fmt::format("{}.top_m is {}; it must be above base_m", path, top_m);
    return layer;
}

Json air_json(const config::Air& air) {
    return {{"visibility_m", air.visibility_m}, {"temperature_c", air.temperature_c},
            {"pressure_hpa", air.pressure_hpa}, {"humidity_pct", air.humidity_pct},
            {"wind_m_s", air.wind_m_s},         {"wind_from_deg", air.wind_from_deg}};
}

config::Air air_from_json(const Json& json, std::string& fault) {
    config::Air air;
    MemberReader members(json, "air", fault);
    members.number("visibility_m", 10.0, 400'000.0, air.visibility_m);
    members.number("temperature_c", -90.0, 60.0, air.temperature_c);
    members.number("pressure_hpa", 800.0, 1100.0, air.pressure_hpa);
    members.number("humidity_pct", 0.0, 100.0, air.humidity_pct);
    members.number("wind_m_s", 0.0, 60.0, air.wind_m_s);
    members.number("wind_from_deg", -360.0, 360.0, air.wind_from_deg);
    return air;
}

/// The type of a layer as /status tells it; nothing for one that this daemon draws nothing of.
std::optional<LayerType> type_of_status(int id, int cloud_type) {
    if (cloud_type >= 1 && cloud_type <= 10)
        return static_cast<LayerType>(static_cast<int>(LayerType::kAltocumulus) + cloud_type - 1);
    constexpr int kFirstOther = 13;
    constexpr std::array<LayerType, kFirstOther> kTypes{
        LayerType::kFog,     LayerType::kCumulus, LayerType::kCumulus, LayerType::kCumulus, LayerType::kRain,
        LayerType::kSnow,    LayerType::kSleet,   LayerType::kHail,    LayerType::kSand,    LayerType::kDust,
        LayerType::kDrizzle, LayerType::kSmoke,   LayerType::kHaze};
    if (id >= 0 && id < kFirstOther) return kTypes[static_cast<std::size_t>(id)];
    return std::nullopt;
}

Json layers_of(const Json& world) {
    return world.value("weather", Json::object()).value("layers", Json::array());
}

std::optional<WeatherLayer> layer_from_status(const Json& told, double elevation_m) {
    const int id = told.value("id", 0);
    const auto type = type_of_status(id, told.value("cloud_type", 0));
    const double base_m = told.value("base_m", 0.0) - elevation_m;
    const double top_m = told.value("top_m", 0.0) - elevation_m;
    if (!type || !told.value("enabled", false) || top_m <= base_m) return std::nullopt;
    WeatherLayer layer;
    layer.type = *type;
    if (config::is_cloud(*type)) layer.id = id;
    layer.base_m = std::clamp(base_m, kLowest_m, kHighest_m - 1.0);
    layer.thickness_m = std::min(top_m, kHighest_m) - layer.base_m;
    layer.bottom_band_m = told.value("bottom_band_m", 0.0);
    layer.top_band_m = told.value("top_band_m", 0.0);
    layer.coverage = told.value("coverage_pct", 0.0) / 100.0;
    layer.visibility_m = told.value("visibility_m", 0.0);
    layer.severity = told.value("severity", 0);
    layer.lightning = told.value("lightning", false);
    if (config::falls(*type)) layer.rate_mm_h = server::rate_of_water_mm_h(told.value("aerosol_g_m3", 0.0));
    if (const double wind_m_s = told.value("wind_m_s", 0.0); wind_m_s > 0.0) {
        layer.wind_m_s = wind_m_s;
        layer.wind_from_deg = told.value("wind_from_deg", 0.0);
    }
    return layer;
}

bool close_to(double a, double b) noexcept {
    return std::abs(a - b) <= 1e-4 * std::max({std::abs(a), std::abs(b), 1.0});
}

bool same_layer(const cigi::WeatherControl& layer, const Json& told) {
    const auto close = [&told](const char* key, float value) {
        return close_to(told.value(key, -1.0), static_cast<double>(value));
    };
    return told.value("enabled", false) &&
           told.value("cloud_type", -1) == static_cast<int>(layer.cloud_type) &&
           told.value("lightning", false) == layer.random_lightning &&
           told.value("severity", -1) == layer.severity && close("base_m", layer.base_elevation) &&
           close("top_m", layer.base_elevation + layer.thickness) && close("coverage_pct", layer.coverage) &&
           close("visibility_m", layer.visibility) && close("aerosol_g_m3", layer.aerosol) &&
           close("wind_m_s", layer.wind_horizontal);
}

cigi::AtmosphereControl atmosphere(const config::Air& air) noexcept {
    cigi::AtmosphereControl control;
    control.model_enable = true;
    control.humidity = static_cast<std::uint8_t>(std::lround(air.humidity_pct));
    control.air_temperature = static_cast<float>(air.temperature_c);
    control.visibility = static_cast<float>(air.visibility_m);
    control.wind_horizontal = static_cast<float>(air.wind_m_s);
    control.wind_direction = static_cast<float>(air.wind_from_deg);
    control.pressure = static_cast<float>(air.pressure_hpa);
    return control;
}

bool has_layer(const std::vector<cigi::WeatherControl>& layers, int id) noexcept {
    return std::any_of(layers.begin(), layers.end(),
                       [id](const cigi::WeatherControl& layer) { return layer.layer_id == id; });
}

}  // namespace

void number_layers(Setting& setting) {
    std::vector<WeatherLayer>& layers = setting.layers;
    const auto used = [&layers](int id) {
        return std::any_of(layers.begin(), layers.end(), [id](const auto& layer) { return layer.id == id; });
    };
    for (WeatherLayer& layer : layers) {
        if (!config::is_cloud(layer.type) || layer.id) continue;
        int id = static_cast<int>(server::LayerId::kCloud1);
        while (id < 255 && used(id))
            id = id == static_cast<int>(server::LayerId::kCloud3)
                     ? static_cast<int>(server::LayerId::kFirstOwnCloud)
                     : id + 1;
        layer.id = id;
    }
    std::vector<WeatherLayer> kept;
    for (const WeatherLayer& layer : layers) {
        std::erase_if(kept, [&layer](const WeatherLayer& before) {
            return config::is_cloud(layer.type) ? before.id == layer.id : before.type == layer.type;
        });
        kept.push_back(layer);
    }
    layers = std::move(kept);
}

Json to_json(const Setting& setting) {
    Json json{{"air", air_json(setting.air)}, {"layers", Json::array()}, {"snow_pct", setting.snow_pct}};
    for (const WeatherLayer& layer : setting.layers)
        json["layers"].push_back(layer_json(layer));
    return json;
}

protocol::Result<Setting, std::string> setting_from_json(const Json& json) {
    std::string fault;
    Setting setting;
    if (!json.is_object() || !json.contains("air") || !json["air"].is_object() || !json.contains("layers") ||
        !json["layers"].is_array())
        return protocol::Error{std::string("weather must have an object \"air\" and a list \"layers\"")};
    if (json["layers"].size() > config::kMaxWeatherLayers)
        return protocol::Error{
            fmt::format("layers holds {}; at most {}", json["layers"].size(), config::kMaxWeatherLayers)};
    setting.air = air_from_json(json["air"], fault);
    MemberReader(json, "weather", fault).number("snow_pct", 0.0, 100.0, setting.snow_pct);
    for (std::size_t i = 0; i < json["layers"].size(); ++i)
        setting.layers.push_back(layer_from_json(json["layers"][i], fmt::format("layers[{}]", i), fault));
    if (!fault.empty()) return protocol::Error{fault};
    number_layers(setting);
    return setting;
}

std::optional<Setting> preset_setting(std::string_view name) {
    const auto* const known = std::find(config::kPresetNames.begin(), config::kPresetNames.end(), name);
    config::Config read;
    if (known == config::kPresetNames.end() || !config::apply_preset(std::string(name), read).empty())
        return std::nullopt;
    Setting setting{read.air, read.weather.layers, read.ground.snow_pct};
    number_layers(setting);
    return setting;
}

std::string preset_title(std::string_view name) {
    std::string_view text = config::preset_text(fmt::format("{}.toml", name)).value_or("");
    text = text.substr(0, text.find('\n'));
    text = text.substr(0, text.find(" Heights are"));
    return std::string(text.starts_with("# ") ? text.substr(2) : text);
}

Setting setting_from_status(const Json& world) {
    std::string fault;
    Setting setting;
    if (world.contains("air")) {
        setting.air = air_from_json(world["air"], fault);
        setting.air.wind_m_s = std::clamp(world["air"].value("wind_horizontal_m_s", 0.0), 0.0, 60.0);
    }
    const double elevation_m = elevation_of(world);
    for (const Json& told : layers_of(world)) {
        if (const auto layer = layer_from_status(told, elevation_m)) setting.layers.push_back(*layer);
    }
    return setting;
}

double elevation_of(const Json& world) {
    return world.value("weather", Json::object()).value("elevation_m", 0.0);
}

bool add_packets(cigi::MessageWriter& writer, const Setting& setting, double elevation_m, const Json& world) {
    const std::vector<cigi::WeatherControl> layers =
        server::weather_controls(setting.layers, setting.air, elevation_m);
    bool room = writer.add(atmosphere(setting.air));
    for (const Json& told : layers_of(world)) {
        const int id = told.value("id", 0);
        if (has_layer(layers, id) || !told.value("enabled", false)) continue;
        cigi::WeatherControl off;
        off.layer_id = static_cast<std::uint8_t>(id);
        room = writer.add(off) && room;
    }
    for (const cigi::WeatherControl& layer : layers)
        room = writer.add(layer) && room;
    cigi::TerrestrialSurfaceControl snow;
    snow.condition_id = kSnowCondition;
    snow.enable = setting.snow_pct > 0.0;
    snow.coverage = static_cast<std::uint8_t>(std::lround(setting.snow_pct));
    return writer.add(snow) && room;
}

bool is_shown(const Setting& setting, const Json& world) {
    const std::vector<cigi::WeatherControl> layers =
        server::weather_controls(setting.layers, setting.air, elevation_of(world));
    const Json told = layers_of(world);
    const auto shown = [&told](const cigi::WeatherControl& layer) {
        return std::any_of(told.begin(), told.end(), [&layer](const Json& one) {
            return one.value("id", -1) == layer.layer_id && same_layer(layer, one);
        });
    };
    const auto wanted = [&layers](const Json& one) {
        return !one.value("enabled", false) || has_layer(layers, one.value("id", 0));
    };
    const Json air = world.value("air", Json::object());
    return close_to(air.value("visibility_m", 0.0), setting.air.visibility_m) &&
           close_to(air.value("temperature_c", -999.0), setting.air.temperature_c) &&
           close_to(air.value("wind_horizontal_m_s", -1.0), setting.air.wind_m_s) &&
           std::all_of(layers.begin(), layers.end(), shown) && std::all_of(told.begin(), told.end(), wanted);
}

}  // namespace skyig::clients::instructor
