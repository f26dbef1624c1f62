// The bodies as they are typed.
#pragma once

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>

#include "server/ephemeris/bodies.h"

namespace skyig::clients::ephem {

/// In capitals or not.
[[nodiscard]] inline std::optional<server::ephemeris::Body> parse_body(std::string_view text) {
    const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    for (const server::ephemeris::Body body : server::ephemeris::kBodies) {
        const std::string_view name = name_of(body);
        if (std::equal(text.begin(), text.end(), name.begin(), name.end(), same)) return body;
    }
    return std::nullopt;
}

/// "sun, moon, ...", for help and error lines.
[[nodiscard]] inline std::string body_list() {
    std::string list;
    for (const std::string_view name : server::ephemeris::kBodyNames)
        list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

}  // namespace skyig::clients::ephem
