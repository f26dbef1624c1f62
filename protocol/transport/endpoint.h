// IPv4 address and port, with their text form.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/result.h"

namespace skyig::protocol::transport {

/// 127.0.0.1 is 0x7F000001, on every machine.
using Ipv4 = std::uint32_t;

struct Endpoint {
    Ipv4 address = 0;
    std::uint16_t port = 0;

    friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// "127.0.0.1": four decimal numbers 0..255 without leading zeros. The error is one line that says what would
/// be right.
[[nodiscard]] Result<Ipv4, std::string> parse_ipv4(std::string_view text);

/// "127.0.0.1:8004"; port 0..65535, where 0 lets the system choose one.
[[nodiscard]] Result<Endpoint, std::string> parse_endpoint(std::string_view text);

[[nodiscard]] std::string to_string(Ipv4 address);
[[nodiscard]] std::string to_string(const Endpoint& endpoint);

}  // namespace skyig::protocol::transport
