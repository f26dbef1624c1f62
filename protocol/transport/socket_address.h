// Endpoints as the system's socket calls take them; for the sockets of this folder.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <string>
#include <string_view>

#include "protocol/transport/endpoint.h"

namespace skyig::protocol::transport {

[[nodiscard]] inline sockaddr_in to_sockaddr(const Endpoint& endpoint) noexcept {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(endpoint.port);
    address.sin_addr.s_addr = htonl(endpoint.address);
    return address;
}

[[nodiscard]] inline Endpoint to_endpoint(const sockaddr_in& address) noexcept {
    return {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
}

/// One line for a failed bind() or listen(): what failed and what would help. `kind`: "udp", "tcp".
[[nodiscard]] std::string bind_error(std::string_view kind, const Endpoint& endpoint, int error);

}  // namespace skyig::protocol::transport
