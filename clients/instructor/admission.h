// Who may speak to the station: by the name that it was asked by, the page that asks, and a token. Pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/status/http.h"

namespace skyig::clients::instructor {

struct AdmissionRules {
    /// It listens on a loopback address: no name of the world leads there.
    bool loopback = true;
    /// Asked of every WebSocket where it is not empty.
    std::string token;
    /// Names beside addresses in numbers and "localhost" that Host may have, without port: those of a reverse
    /// proxy.
    std::vector<std::string> names;
};

enum class Refusal : unsigned char { kNone, kHost, kOrigin, kToken };

/// Any request: the name in Host is one of ours. A page elsewhere that had its own name resolved to this
/// machine is told by it. With a token and off loopback any name will do.
[[nodiscard]] Refusal check_host(const server::status::HttpRequest& request, const AdmissionRules& rules);

/// A WebSocket besides: the page that opens it came from here (Origin is there, and its host and port are
/// those of Host), and the query's "token=" is right.
[[nodiscard]] Refusal check_upgrade(const server::status::HttpRequest& request, const AdmissionRules& rules);

}  // namespace skyig::clients::instructor
