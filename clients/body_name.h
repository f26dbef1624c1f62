// The bodies as they are typed.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "clients/letters.h"
#include "server/ephemeris/bodies.h"

namespace skyig::clients {

/// In capitals or not.
[[nodiscard]] inline std::optional<server::ephemeris::Body> parse_body(std::string_view text) {
    for (const server::ephemeris::Body body : server::ephemeris::kBodies) {
        if (same_letters(text, name_of(body))) return body;
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

}  // namespace skyig::clients
