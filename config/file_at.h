// Files that keys of the settings name.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "config/schema.h"
#include "config/warp/bytes.h"

namespace skyig::config {

/// The file that a key names, through `read`: (bytes) -> warp::FileRead. An error at the key if it cannot be
/// used.
template <class Read>
auto file_at(TableReader& table, std::string_view key, const std::string& settings_file, Read read)
    -> decltype(read(warp::Bytes{}).value) {
    std::string path;
    const Value* value = table.text(key, path);
    if (value == nullptr) return std::nullopt;
    warp::FileRead<warp::Bytes> bytes = warp::read_bytes(beside(settings_file, path));
    std::string fault = std::move(bytes.fault);
    if (bytes.value) {
        auto result = read(std::move(*bytes.value));
        if (result.value) return std::move(result.value);
        fault = std::move(result.fault);
    }
    table.error(*value, key, fmt::format("is \"{}\", which cannot be used: {}", path, fault));
    return std::nullopt;
}

}  // namespace skyig::config
