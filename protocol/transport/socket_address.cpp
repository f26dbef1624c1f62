#include "protocol/transport/socket_address.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace skyig::protocol::transport {

std::string bind_error(std::string_view kind, const Endpoint& endpoint, int error) {
    std::string_view reason;
    switch (error) {
        case EADDRINUSE:
            reason = "address already in use; stop the other program or choose another listen port";
            break;
        case EADDRNOTAVAIL:
            reason = "this machine has no such address; listen on one of its own, 127.0.0.1 or 0.0.0.0";
            break;
        case EACCES:
            reason = "not permitted; choose a listen port above 1023";
            break;
        default:
            return fmt::format("{} {}: {}", kind, to_string(endpoint), std::strerror(error));
    }
    return fmt::format("{} {}: {}", kind, to_string(endpoint), reason);
}

}  // namespace skyig::protocol::transport
