#include "config/presets.h"

#include <fmt/format.h>

#include <filesystem>

#include "config/nearest.h"
#include "config/schema.h"

namespace skyig::config {
namespace {

bool is_path(std::string_view preset) {
    return preset.find('/') != std::string_view::npos || preset.ends_with(".toml");
}

std::string unknown_preset(std::string_view preset) {
    std::string names;
    for (const std::string_view name : kPresetNames)
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
    const std::string_view near = nearest(preset, kPresetNames);
    const std::string hint = near.empty() ? std::string() : fmt::format("; did you mean \"{}\"?", near);
    return fmt::format("is \"{}\"; it must be one of {}, or the path of a file such as \"./my.toml\"{}",
                       preset, names, hint);
}

}  // namespace

std::string apply_preset(const std::string& preset, Config& config) {
    std::optional<std::string> read;
    if (is_path(preset)) {
        ConfigError error;
        read = read_settings_text(preset, error);
        if (!read) return to_text(error);
    }
    const std::string file = read ? preset : preset + ".toml";
    const std::optional<std::string_view> text = read ? std::string_view(*read) : preset_text(file);
    if (!text) return unknown_preset(preset);
    Table root;
    ConfigError syntax{file, 0, 0, {}, {}};
    if (!parse_document(*text, root, syntax)) return to_text(syntax);
    ErrorList errors(file);
    TableReader reader(errors, &root, {}, {});
    Config made = config;
    made.weather.layers.clear();
    made.weather.areas.clear();
    made.weather.metar.clear();
    read_version(reader);
    read_air(reader.table("air"), made.air);
    read_ground(reader.table("ground"), made.ground);
    if (TableReader weather = reader.table("weather"); weather.has("preset"))
        weather.error(*weather.any("preset"), "preset", "stands in a preset; presets do not build on others");
    read_weather(reader.table("weather"), errors, made.weather);
    reader.finish();
    if (!errors.empty()) return to_text(std::move(errors).sorted().front());
    config = std::move(made);
    config.weather.preset = preset;
    return {};
}

void read_preset(const Table& root, ErrorList& errors, Config& config) {
    const Value* weather = root.find("weather");
    const auto* table = weather == nullptr ? nullptr : std::get_if<Table>(&weather->data);
    const Value* value = table == nullptr ? nullptr : table->find("preset");
    const auto* preset = value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
    // Of another type or empty: who reads [weather] says so.
    if (preset == nullptr || preset->empty()) return;
    const std::filesystem::path beside = std::filesystem::path(errors.file()).parent_path();
    const std::string named = is_path(*preset) ? (beside / *preset).string() : *preset;
    if (const std::string fault = apply_preset(named, config); !fault.empty())
        errors.add(value->place, "weather.preset", fault);
}

}  // namespace skyig::config
