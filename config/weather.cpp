#include "config/weather.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 4> kCloudModelNames{"auto", "layer", "impostor", "volume"};
constexpr std::array<std::string_view, 2> kDriverNames{"layers", "keyframes"};
constexpr double kMetresPerFoot = 0.3048;
constexpr double kMostHeight_m = 30'000.0;
constexpr double kMostHalfSize_m = 1'000'000.0;

/// A length that may be told in metres or in feet, but not in both. \return whether it is there
bool read_length(TableReader& table, std::string_view metres, std::string_view feet, double least_m,
                 double& out_m, bool above_least = false) {
    const bool both = table.has(metres) && table.has(feet);
    const bool told = table.has(metres) || table.has(feet);
    std::optional<double> read_m, read_ft;
    table.number(metres, read_m, {least_m, kMostHeight_m, "m", above_least});
    const Value* value = table.number(
        feet, read_ft, {least_m / kMetresPerFoot, kMostHeight_m / kMetresPerFoot, "ft", above_least});
    if (value != nullptr && both)
        table.error(*value, feet, fmt::format("stands beside {}; only one of them may be given", metres));
    out_m = read_ft ? *read_ft * kMetresPerFoot : read_m.value_or(out_m);
    return told;
}

void read_extent(TableReader& table, WeatherLayer& layer) {
    const bool has_base = read_length(table, "base_m", "base_ft", -1000.0, layer.base_m);
    if (!has_base && is_cloud(layer.type))
        table.require("base_m", "its height above weather.elevation_m, or base_ft in its place");
    double top_m = 0.0;
    const bool has_top = read_length(table, "top_m", "top_ft", -1000.0, top_m);
    const bool has_thickness =
        read_length(table, "thickness_m", "thickness_ft", 0.0, layer.thickness_m, true);
    const std::string_view top_key = table.has("top_ft") ? "top_ft" : "top_m";
    if (has_top && has_thickness) {
        table.error(*table.any(top_key), top_key, "stands beside its thickness; only one may be given");
    } else if (has_top) {
        layer.thickness_m = top_m - layer.base_m;
        if (layer.thickness_m <= 0.0)
            table.error(*table.any(top_key), top_key, "is not above the base; it must be");
    } else if (!has_thickness) {
        table.require("top_m", "the height of its top, or top_ft, thickness_m or thickness_ft in its place");
    }
    double band_m = is_cloud(layer.type) ? 30.0 : 0.0;
    read_length(table, "band_m", "band_ft", 0.0, band_m);
    layer.bottom_band_m = layer.top_band_m = band_m;
    read_length(table, "bottom_band_m", "bottom_band_ft", 0.0, layer.bottom_band_m);
    read_length(table, "top_band_m", "top_band_ft", 0.0, layer.top_band_m);
}

void read_amount(TableReader& table, WeatherLayer& layer) {
    std::optional<double> in_oktas, in_pct;
    const Value* oktas = table.number("coverage_oktas", in_oktas, {0.0, 8.0, "oktas"});
    if (in_oktas) layer.coverage = *in_oktas / 8.0;
    const Value* percent = table.number("coverage_pct", in_pct, {0.0, 100.0, "%"});
    if (in_pct) layer.coverage = *in_pct / 100.0;
    if (oktas != nullptr && percent != nullptr)
        table.error(*percent, "coverage_pct", "stands beside coverage_oktas; only one of them may be given");
    std::optional<double> visibility_m;
    table.number("visibility_m", visibility_m, {5.0, 400'000.0, "m"});
    layer.visibility_m = visibility_m.value_or(layer.visibility_m);
    if (!is_cloud(layer.type) && !falls(layer.type))
        table.require("visibility_m", "how far one sees inside it, 5..400000 m");
    table.integer("severity", layer.severity, 0, 5);
    if (falls(layer.type)) {
        std::optional<double> rate_mm_h;
        table.number("rate_mm_h", rate_mm_h, {0.0, 300.0, "mm/h", true});
        layer.rate_mm_h = rate_mm_h.value_or(layer.rate_mm_h);
    } else if (const Value* rate = table.any("rate_mm_h"); rate != nullptr) {
        table.error(*rate, "rate_mm_h", "is of what falls alone: drizzle, rain, snow, sleet, hail");
    }
}

void read_cloud_extras(TableReader& table, WeatherLayer& layer) {
    if (is_cloud(layer.type)) {
        table.number("scud_pct", layer.bottom_scud_pct, {0.0, 100.0, "%"});
        table.number("top_scud_pct", layer.top_scud_pct, {0.0, 100.0, "%"});
        table.boolean("lightning", layer.lightning);
        return;
    }
    for (const std::string_view key : {"scud_pct", "top_scud_pct", "lightning"}) {
        if (const Value* value = table.any(key); value != nullptr)
            table.error(*value, key, "is of clouds alone");
    }
}

void read_layer(TableReader& table, WeatherLayer& layer) {
    table.require("type", "what it is: \"cumulus\", \"stratus\", \"fog\", \"rain\" ...");
    table.choice("type", layer.type, kLayerTypeNames);
    if (const Value* value = table.integer("id", layer.id, 1, 255)) {
        if (!is_cloud(layer.type)) table.error(*value, "id", "is of clouds alone");
        if (layer.id > 3 && layer.id < 14)
            table.error(*value, "id",
                        fmt::format("is {}, that of another type; it must be 1..3 or 14..255", *layer.id));
    }
    read_extent(table, layer);
    read_amount(table, layer);
    read_cloud_extras(table, layer);
    table.number("wind_m_s", layer.wind_m_s, {0.0, 150.0, "m/s"});
    std::optional<double> from_deg;
    const Value* from = table.number("wind_from_deg", from_deg, {-360.0, 360.0, "degrees"});
    layer.wind_from_deg = from_deg.value_or(layer.wind_from_deg);
    if (from != nullptr && !table.has("wind_m_s"))
        table.error(*from, "wind_from_deg", "stands without wind_m_s; give both or none");
}

void read_layers(TableReader& owner, ErrorList& errors, std::string_view list_path,
                 std::vector<WeatherLayer>& layers) {
    read_tables(owner, errors, "layer", list_path, layers.size(), kMaxWeatherLayers,
                [&layers](TableReader& item) { read_layer(item, layers.emplace_back()); });
}

void read_shape(TableReader& table, WeatherArea& area) {
    table.require("half_length_m", "from its middle to its edge, along its rotation");
    table.number("half_length_m", area.half_length_m, {0.0, kMostHalfSize_m, "m", true});
    area.half_width_m = area.half_length_m;
    table.number("half_width_m", area.half_width_m, {0.0, kMostHalfSize_m, "m", true});
    const double most_m = std::min(area.half_length_m, area.half_width_m);
    table.number("corner_radius_m", area.corner_radius_m, {0.0, most_m, "m"});
    table.number("perimeter_m", area.perimeter_m, {0.0, kMostHalfSize_m, "m"});
    table.number("rotation_deg", area.rotation_deg, {-360.0, 360.0, "degrees"});
}

void read_area(TableReader& table, ErrorList& errors, WeatherArea& area) {
    table.integer("id", area.id, 1, 65535);
    table.require("latitude_deg", "where its middle is, -90..90");
    table.number("latitude_deg", area.latitude_deg, {-90.0, 90.0, "degrees"});
    table.require("longitude_deg", "where its middle is, -180..180");
    table.number("longitude_deg", area.longitude_deg, {-180.0, 180.0, "degrees"});
    read_shape(table, area);
    table.boolean("merge", area.merge);
    table.require("layer", "what weather it holds: [[weather.area.layer]] tables");
    read_layers(table, errors, "weather.area.layer", area.layers);
}

void read_areas(TableReader& weather, ErrorList& errors, std::vector<WeatherArea>& areas) {
    read_tables(
        weather, errors, "area", "weather.area", areas.size(), kMaxWeatherAreas, [&](TableReader& item) {
            WeatherArea area;
            read_area(item, errors, area);
            const bool taken = area.id && std::any_of(areas.begin(), areas.end(),
                                                      [&](const auto& a) { return a.id == area.id; });
            if (taken)
                item.error(*item.any("id"), "id", fmt::format("is {}, that of another area", *area.id));
            areas.push_back(std::move(area));
        });
}

}  // namespace

void read_weather(TableReader table, ErrorList& errors, Weather& weather) {
    const Value* preset = table.text("preset", weather.preset);
    if (preset != nullptr && weather.preset.empty())
        table.error(*preset, "preset", "is empty; it must name a preset or a file, or be left out");
    const Value* metar = table.text("metar", weather.metar);
    if (metar != nullptr && weather.metar.empty())
        table.error(*metar, "metar", "is empty; it must be a weather report, or be left out");
    if (metar != nullptr && preset != nullptr)
        table.error(*metar, "metar", "stands beside preset; give one of them");
    table.number("elevation_m", weather.elevation_m, {-500.0, 9000.0, "m"});
    table.number("transition_s", weather.transition_s, {0.0, 600.0, "s"});
    table.choice("clouds", weather.clouds, kCloudModelNames);
    table.choice("driver", weather.driver, kDriverNames);
    read_keyframes(table.table("keyframes"), weather.keyframes);
    read_tables(table, errors, "sheet", "weather.sheet", weather.sheets.size(), kMaxWeatherSheets,
                [&](TableReader& item) { read_weather_sheet(item, errors, weather.sheets.emplace_back()); });
    read_layers(table, errors, "weather.layer", weather.layers);
    read_areas(table, errors, weather.areas);
    table.finish();
}

}  // namespace skyig::config
