// An IPv4 address and a port as plain values.
#pragma once

#include <cstdint>
#include <string>

namespace skyig::config {

/// Dotted-quad IPv4 address and port: of UDP, but for the status port.
struct UdpAddress {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;

    friend bool operator==(const UdpAddress&, const UdpAddress&) = default;
};

}  // namespace skyig::config
