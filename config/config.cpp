#include "config/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "config/document.h"
#include "config/schema.h"

namespace skyig::config {
namespace {

std::string_view output_name(OutputKind kind) {
    return kind == OutputKind::kWindow ? "in windows" : "headless";
}

}  // namespace

std::string beside(const std::string& settings_file, const std::string& path) {
    return path.empty() ? path : (std::filesystem::path(settings_file).parent_path() / path).string();
}

LoadResult parse_config(std::string_view text, const std::string& file_name, KeyLog* keys) {
    Table root;
    ConfigError syntax{file_name, 0, 0, {}, {}};
    if (!parse_document(text, root, syntax)) return {std::nullopt, {std::move(syntax)}};
    ErrorList errors(file_name, keys);
    LoadResult result;
    Config config = read_config(root, errors);
    config.ephemeris.earth_orientation = beside(file_name, config.ephemeris.earth_orientation);
    config.record.file = beside(file_name, config.record.file);
    if (errors.empty()) {
        result.config = std::move(config);
    } else {
        result.errors = std::move(errors).sorted();
    }
    return result;
}

LoadResult load_config(const std::string& path, KeyLog* keys) {
    ConfigError error;
    const std::optional<std::string> text = read_settings_text(path, error);
    if (!text) return {std::nullopt, {std::move(error)}};
    return parse_config(*text, path, keys);
}

Config default_config() {
    Config config;
    config.channels.emplace_back().name = "centre";
    return config;
}

void show_pattern(Config& config, std::string_view pattern) noexcept {
    const auto* const at = std::find(kPatternNames.begin(), kPatternNames.end(), pattern);
    if (at == kPatternNames.end()) return;
    for (Channel& channel : config.channels)
        channel.pattern = static_cast<Pattern>(at - kPatternNames.begin());
}

std::string to_text(const ConfigError& error) {
    std::string text = error.file;
    if (error.line > 0) text += fmt::format(":{}:{}", error.line, error.column);
    if (!error.key.empty()) text += fmt::format(": {}", error.key);
    return text + fmt::format(": {}", error.message);
}

namespace {

/// ", weather cat1 of 2 layers and 1 area"; empty where nothing is said of it.
std::string weather_text(const Weather& weather) {
    std::string text;
    if (!weather.preset.empty()) text = fmt::format(", weather {}", weather.preset);
    if (!weather.metar.empty()) text = fmt::format(", weather of {}", weather.metar);
    if (weather.driver == WeatherDriver::kKeyframes)
        text += text.empty() ? ", weather by keyframes" : " by keyframes";
    const auto counted = [](std::size_t count, std::string_view of) {
        return fmt::format("{} {}{}", count, of, count == 1 ? "" : "s");
    };
    std::string parts;
    if (!weather.layers.empty()) parts = counted(weather.layers.size(), "layer");
    if (!weather.areas.empty())
        parts += (parts.empty() ? "" : " and ") + counted(weather.areas.size(), "area");
    if (parts.empty()) return text;
    return fmt::format("{} of {}", text.empty() ? ", weather" : text, parts);
}

}  // namespace

std::string describe(const Config& config) {
    const std::size_t count = config.channels.size();
    std::string heard = config.host.enabled ? fmt::format("CIGI 3.3+4.0 on udp {}:{}",
                                                          config.host.listen.address, config.host.listen.port)
                                            : std::string("no host");
    for (const Source& source : config.sources) {
        const bool bus = source.kind == SourceKind::kCanAerospace;
        heard +=
            bus ? fmt::format(", {} on {}", source.name, source.interface)
                : fmt::format(", {} on udp {}:{}", source.name, source.listen.address, source.listen.port);
    }
    const std::string status =
        config.status.enabled
            ? fmt::format("status on http://{}:{}", config.status.listen.address, config.status.listen.port)
            : std::string("no status port");
    return fmt::format("ok: {} channel{}, {}, {}, {}{}", count, count == 1 ? "" : "s", heard,
                       output_name(config.output.kind), status, weather_text(config.weather));
}

}  // namespace skyig::config
