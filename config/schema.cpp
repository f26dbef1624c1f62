#include "config/schema.h"

#include <fmt/format.h>

#include <array>

#include "config/presets.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 3> kModelNames{"almanac", "erfa", "series"};
constexpr std::array<std::string_view, 2> kSurfaceNames{"land", "sea"};
constexpr std::array<std::string_view, 2> kOutputNames{"headless", "window"};
constexpr std::array<std::string_view, 4> kLevelNames{"error", "warning", "notice", "info"};

void read_utc(TableReader& table, std::optional<UtcDateTime>& utc) {
    const Value* value = table.any("utc");
    if (value == nullptr) return;
    UtcDateTime time;
    const auto* text = std::get_if<std::string>(&value->data);
    if (text != nullptr && *text == "now") {
        utc.reset();
        return;
    }
    bool good = text != nullptr && parse_utc(*text, time);
    if (const auto* date = std::get_if<UtcDateTime>(&value->data)) {
        time = *date;
        good = is_valid(time);
    }
    if (!good) {
        const std::string read =
            text == nullptr ? std::string(type_name(*value)) : fmt::format("\"{}\"", *text);
        table.error(
            *value, "utc",
            fmt::format(
                "is {}; it must be \"now\" or UTC with a Z, years 1900..2100, such as 2026-06-21T12:00:00Z",
                std::holds_alternative<UtcDateTime>(value->data) ? "out of range" : read));
        return;
    }
    utc = time;
}

void read_start(TableReader table, Start& start) {
    read_utc(table, start.utc);
    table.describe("utc", "years 1900..2100, \"now\"", start.utc ? to_toml(*start.utc) : to_toml("now"));
    table.boolean("running", start.running);
    table.number("latitude_deg", start.latitude_deg, {-90.0, 90.0, "degrees"});
    table.number("longitude_deg", start.longitude_deg, {-180.0, 180.0, "degrees"});
    table.number("height_m", start.height_m, {-500.0, 100'000.0, "m"});
    table.number("yaw_deg", start.yaw_deg, {-360.0, 360.0, "degrees"});
    table.number("pitch_deg", start.pitch_deg, {-90.0, 90.0, "degrees"});
    table.number("roll_deg", start.roll_deg, {-180.0, 180.0, "degrees"});
    table.finish();
}

void read_ephemeris(TableReader table, Ephemeris& ephemeris) {
    table.choice("model", ephemeris.model, kModelNames);
    const Value* value = table.text("earth_orientation", ephemeris.earth_orientation);
    if (value != nullptr && ephemeris.earth_orientation.empty())
        table.error(*value, "earth_orientation", "is empty; it must name a file, or be left out");
    table.finish();
}

void read_quality(TableReader table, Quality& quality) {
    const Value* codes = table.number("error_codes", quality.error_codes, {0.1, 8.0, "display codes"});
    const Value* percent = table.number("error_pct", quality.error_pct, {0.17, 13.0, "%"});
    if (codes != nullptr && percent != nullptr)
        table.error(*percent, "error_pct", "stands beside error_codes; give one of them");
    table.finish();
}

void read_output(TableReader table, Output& output) {
    table.choice("kind", output.kind, kOutputNames);
    table.boolean("vsync", output.vsync);
    table.finish();
}

void read_record(TableReader table, Record& record) {
    const Value* value = table.text("file", record.file);
    if (value != nullptr && record.file.empty())
        table.error(*value, "file", "is empty; it must name a file such as \"{time}.pcapng\"");
    // Another word in braces would become a part of the name, and every run would write over the last.
    std::string rest = record.file;
    if (const std::size_t at = rest.find(kRecordTimeMark); at != std::string::npos)
        rest.erase(at, kRecordTimeMark.size());
    if (value != nullptr && rest.find_first_of("{}") != std::string::npos) {
        table.error(*value, "file",
                    fmt::format("is \"{}\"; {} may stand in it once, other braces may not", record.file,
                                kRecordTimeMark));
    }
    table.finish();
}

void read_log(TableReader table, Logging& log) {
    table.choice("level", log.level, kLevelNames);
    table.finish();
}

void read_preview(TableReader table, Preview& preview) {
    table.boolean("enabled", preview.enabled);
    table.number("rate_hz", preview.rate_hz, {0.1, 30.0, "Hz"});
    table.integer("width_px", preview.width_px, 16, 4096, "pixels");
    table.integer("quality", preview.quality, 1, 100);
    table.finish();
}

}  // namespace

void read_version(TableReader& root) {
    int version = 1;
    const Value* value = root.integer("version", version, 0, 1'000'000);
    if (value != nullptr && version != 1) {
        root.error(*value, "version", fmt::format("is {}; this program reads version 1", version));
    }
    root.require("version", "1, the version of the file's layout (version = 1, above all tables)");
}

void read_air(TableReader table, Air& air) {
    table.number("visibility_m", air.visibility_m, {10.0, 400'000.0, "m"});
    table.number("visibility_contrast", air.visibility_contrast, {0.01, 0.1, {}});
    table.number("temperature_c", air.temperature_c, {-90.0, 60.0, "degrees Celsius"});
    table.number("pressure_hpa", air.pressure_hpa, {800.0, 1100.0, "hPa"});
    table.number("humidity_pct", air.humidity_pct, {0.0, 100.0, "%"});
    table.number("wind_m_s", air.wind_m_s, {0.0, 60.0, "m/s"});
    table.number("wind_from_deg", air.wind_from_deg, {-360.0, 360.0, "degrees"});
    table.finish();
}

void read_ground(TableReader table, Ground& ground) {
    table.choice("surface", ground.surface, kSurfaceNames);
    table.number("albedo", ground.albedo, {0.0, 1.0, {}});
    table.number("snow_pct", ground.snow_pct, {0.0, 100.0, "%"});
    table.finish();
}

Config read_config(const Table& document, ErrorList& errors) {
    Config config;
    TableReader root(errors, &document, {}, {});
    read_version(root);
    read_preset(document, errors, config);
    TableReader daemon = root.table("daemon");
    read_daemon(daemon, config.daemon);
    read_overload(root.table("overload"), config.overload);
    TableReader host = root.table("host");
    read_host(host, config.host);
    read_sources(root, errors, config.host, config.sources);
    read_start(root.table("start"), config.start);
    read_air(root.table("air"), config.air);
    read_ground(root.table("ground"), config.ground);
    read_sky(root.table("sky"), config.sky);
    read_night(root.table("night"), errors, config.night);
    read_weather(root.table("weather"), errors, config.weather);
    read_ephemeris(root.table("ephemeris"), config.ephemeris);
    read_display(root.table("display"), config.display);
    read_quality(root.table("quality"), config.quality);
    read_eye(root.table("eye"), config.eye);
    TableReader overlay = root.table("overlay");
    read_overlay(overlay, config.overlay);
    overlay.finish();
    read_output(root.table("output"), config.output);
    read_record(root.table("record"), config.record);
    read_log(root.table("log"), config.log);
    TableReader status = root.table("status");
    read_status(status, config.status);
    read_preview(root.table("preview"), config.preview);
    read_windows(root, errors, config.windows);
    read_rig(root, errors, config.rig);
    read_channels(root, errors, config);
    place_channels(errors, config);
    check_windows_of_nodes(errors, config, {});
    check_pacing(daemon, config);
    root.finish();
    return config;
}

}  // namespace skyig::config
