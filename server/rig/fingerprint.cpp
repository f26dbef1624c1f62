#include "server/rig/fingerprint.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "server/rig/tag.h"

namespace skyig::server::rig {

namespace {

namespace fs = std::filesystem;

bool is_a_machines_own(const config::KeyUse& use) {
    constexpr std::array<std::string_view, 7> kTables{"status", "preview", "record", "log",
                                                      "output", "window",  "rig"};
    constexpr std::array<std::string_view, 4> kKeys{"listen", "reply_to", "allow", "interface"};
    // Who follows whom is of all.
    if (use.table == "rig" && (use.key == "leader" || use.key == "stand_ins")) return false;
    const std::string_view table = std::string_view(use.table).substr(0, use.table.find_first_of(".["));
    return std::find(kTables.begin(), kTables.end(), table) != kTables.end() ||
           std::find(kKeys.begin(), kKeys.end(), use.key) != kKeys.end();
}

/// What a file of that name holds; empty where there is none.
std::string bytes_of(std::string_view value, const std::string& settings_file) {
    if (value.size() < 3 || value.front() != '"') return {};
    const fs::path path = fs::path(settings_file).parent_path() / value.substr(1, value.size() - 2);
    std::error_code none;
    if (!fs::is_regular_file(path, none)) return {};
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::uint64_t number_of(std::uint64_t before, std::string_view text) {
    return siphash({before, text.size()}, std::as_bytes(std::span{text}));
}

}  // namespace

std::uint64_t fingerprint(const config::KeyLog& keys, const std::string& settings_file) {
    std::uint64_t all = 0;
    for (const config::KeyUse& use : keys.uses()) {
        if (!use.is_value() || !use.value || is_a_machines_own(use)) continue;
        std::uint64_t one = number_of(0, use.table);
        one = number_of(one, use.key);
        // A file counts by what it holds, wherever it lies.
        const std::string bytes = bytes_of(*use.value, settings_file);
        one = number_of(one, bytes.empty() ? std::string_view(*use.value) : std::string_view(bytes));
        // In whatever order they are asked for.
        all += one;
    }
    return all;
}

}  // namespace skyig::server::rig
