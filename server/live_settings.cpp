#include "server/live_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>
#include <utility>

#include "server/bus_input.h"
#include "server/start_weather/start_weather.h"

namespace skyig::server {
namespace {

using config::KeyLog;
using config::KeyUse;

std::string path_of(const KeyUse& use) {
    return use.table.empty() ? use.key : fmt::format("{}.{}", use.table, use.key);
}

const KeyUse* find(const KeyLog& keys, const KeyUse& wanted) {
    const auto found = std::find_if(keys.uses().begin(), keys.uses().end(), [&wanted](const KeyUse& use) {
        return use.key == wanted.key && use.table == wanted.table;
    });
    return found == keys.uses().end() || !found->is_value() ? nullptr : &*found;
}

bool has_table(const KeyLog& keys, const std::string& table) {
    return std::any_of(keys.uses().begin(), keys.uses().end(),
                       [&table](const KeyUse& use) { return use.is_value() && use.table == table; });
}

/// One line for a table, however many keys it has.
void add_line(std::string line, std::vector<std::string>& lines) {
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
}

/// What `now` has and `before` has otherwise or not; with `gone` only the tables that `now` has no more.
void compare(const KeyLog& before, const KeyLog& now, bool live, const std::string& file,
             SettingsChange& change) {
    constexpr std::string_view kLater = "is taken at the next start only";
    for (const KeyUse& use : now.uses()) {
        if (!use.is_value() || is_live(path_of(use)) != live) continue;
        const KeyUse* other = find(before, use);
        if (other != nullptr && other->value == use.value) continue;
        if (live) {
            add_line(path_of(use), change.live);
        } else if (!has_table(before, use.table)) {
            add_line(fmt::format("{}: {}: {}", file, use.table, kLater), change.at_start);
        } else {
            add_line(
                config::to_text({file, use.place.line, use.place.column, path_of(use), std::string(kLater)}),
                change.at_start);
        }
    }
    for (const KeyUse& use : before.uses()) {
        if (!use.is_value() || is_live(path_of(use)) != live || has_table(now, use.table)) continue;
        add_line(live ? use.table : fmt::format("{}: {}: its absence {}", file, use.table, kLater),
                 live ? change.live : change.at_start);
    }
}

/// What can change live, from one into the other.
void copy_live(const config::Config& from, config::Config& to) {
    to.air = from.air;
    to.weather.preset = from.weather.preset;
    to.weather.metar = from.weather.metar;
    to.weather.layers = from.weather.layers;
    to.weather.areas = from.weather.areas;
    to.quality = from.quality;
    to.log = from.log;
    to.host.rights = from.host.rights;
    // By name: sources come and go at a start only.
    for (config::Source& source : to.sources) {
        for (const config::Source& other : from.sources)
            if (other.name == source.name && other.kind == source.kind) source.rights = other.rights;
    }
}

std::string list_of(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words)
        list += fmt::format("{}{}", list.empty() ? "" : ", ", word);
    return list;
}

}  // namespace

bool is_live(const std::string& path) {
    constexpr std::array<std::string_view, 3> kKeys{"weather.preset", "weather.metar", "log.level"};
    constexpr std::array<std::string_view, 4> kTables{"air.", "quality.", "weather.layer[", "weather.area["};
    constexpr std::array<std::string_view, 4> kRights{"owns", "priority", "stale_after_s", "lost_after_s"};
    const auto begins = [&path](std::string_view with) { return path.starts_with(with); };
    if (std::find(kKeys.begin(), kKeys.end(), path) != kKeys.end()) return true;
    if (std::any_of(kTables.begin(), kTables.end(), begins)) return true;
    if (!begins("host.") && !begins("source[")) return false;
    const std::string_view key = std::string_view(path).substr(path.rfind('.') + 1);
    return std::find(kRights.begin(), kRights.end(), key) != kRights.end();
}

SettingsChange compare_settings(const KeyLog& start, const KeyLog& held, const KeyLog& now,
                                const std::string& file) {
    SettingsChange change;
    compare(held, now, true, file, change);
    compare(start, now, false, file, change);
    return change;
}

LiveSettings::LiveSettings(std::string path, const config::Config& start, const KeyLog& keys)
    : path_(std::move(path)), config_(start), start_keys_(keys), held_keys_(keys) {}

LiveSettings::Read LiveSettings::read(const std::string& path) {
    Read read;
    read.loaded = config::load_config(path, &read.keys);
    if (!read.loaded) {
        const std::size_t more = read.loaded.errors.size() - 1;
        read.fault = config::to_text(read.loaded.errors.front());
        if (more > 0) read.fault += fmt::format(" (and {} more; skyigd --check tells all)", more);
        return read;
    }
    read.fault = metar_fault(*read.loaded.config, path);
    if (const std::string fault = identifier_fault(*read.loaded.config); read.fault.empty() && !fault.empty())
        read.fault = fmt::format("{}: {}", path, fault);
    return read;
}

void LiveSettings::read_anew() {
    if (reading_.valid()) {
        again_ = true;
        return;
    }
    reading_ = std::async(std::launch::async, [path = path_] { return read(path); });
}

LiveSettings::Result LiveSettings::take(const Take& take, Log& log) {
    if (!reading_.valid() || reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return Result::kNone;
    Read read = reading_.get();
    if (std::exchange(again_, false)) read_anew();
    if (!read.fault.empty()) {
        log.error("settings not taken, those that held go on: {}", read.fault);
        return Result::kRefused;
    }
    const SettingsChange change = compare_settings(start_keys_, held_keys_, read.keys, path_);
    const config::Config before = config_;
    copy_live(*read.loaded.config, config_);
    held_keys_ = std::move(read.keys);
    take(before);
    log.notice("settings read anew: {}", change.live.empty() ? "nothing to take" : list_of(change.live));
    for (const std::string& line : change.at_start)
        log.warning("{}", line);
    return Result::kTaken;
}

}  // namespace skyig::server
