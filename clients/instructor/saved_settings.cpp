#include "clients/instructor/saved_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace skyig::clients::instructor {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kVersion = 1;

std::string system_fault(const std::string& path) {
    return fmt::format("{}: {}", path, std::strerror(errno));
}

}  // namespace

protocol::Result<SavedSettings, std::string> SavedSettings::open(const std::string& path) {
    SavedSettings saved;
    saved.path_ = path;
    if (path.empty() || !std::filesystem::exists(path)) return saved;
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) return protocol::Error{system_fault(path)};
    const Json json = Json::parse(text.str(), nullptr, false);
    if (!json.is_object() || !json.contains("version") || json["version"] != kVersion ||
        !json.contains("presets") || !json["presets"].is_object())
        return protocol::Error{
            fmt::format("{}: holds no presets of this program (version {})", path, kVersion)};
    for (const auto& [name, value] : json["presets"].items()) {
        const auto setting = setting_from_json(value);
        if (!setting) return protocol::Error{fmt::format("{}: {}: {}", path, name, setting.error())};
        saved.settings_[name] = *setting;
    }
    return saved;
}

std::string SavedSettings::save(const std::string& name, const Setting& setting) {
    const bool printable =
        std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; });
    if (name.empty() || name.size() > kLongestName_bytes || !printable)
        return fmt::format("a preset's name has 1 to {} characters", kLongestName_bytes);
    std::map<std::string, Setting> changed = settings_;
    changed[name] = setting;
    if (changed.size() > kMost) return fmt::format("there are {} presets; remove one first", kMost);
    if (std::string fault = write(changed); !fault.empty()) return fault;
    settings_ = std::move(changed);
    return {};
}

std::string SavedSettings::forget(const std::string& name) {
    std::map<std::string, Setting> changed = settings_;
    if (changed.erase(name) == 0) return fmt::format("there is no preset \"{}\"", name);
    if (std::string fault = write(changed); !fault.empty()) return fault;
    settings_ = std::move(changed);
    return {};
}

/// Beside the file first, so that a full disk costs nothing that was there.
std::string SavedSettings::write(const std::map<std::string, Setting>& settings) const {
    if (path_.empty()) return {};
    Json json{{"version", kVersion}, {"presets", Json::object()}};
    for (const auto& [name, setting] : settings)
        json["presets"][name] = to_json(setting);
    const std::string beside = path_ + ".new";
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, failed);
    {
        std::ofstream out(beside);
        out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
        out.close();
        if (!out) return system_fault(beside);
    }
    std::filesystem::rename(beside, path_, failed);
    return failed ? fmt::format("{}: {}", path_, failed.message()) : std::string();
}

}  // namespace skyig::clients::instructor
