#include "protocol/transport/tcp.h"

#include <poll.h>

#include <cerrno>
#include <cstring>

#include "protocol/transport/socket_address.h"

namespace skyig::protocol::transport {
namespace {

FileDescriptor open_socket() noexcept {
    return FileDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

const sockaddr* generic(const sockaddr_in& address) noexcept {
    return reinterpret_cast<const sockaddr*>(&address);
}

std::string words(int error) {
    switch (error) {
        case ECONNREFUSED:
            return "nobody listens there";
        case ETIMEDOUT:
            return "no answer in time";
        default:
            return std::strerror(error);
    }
}

}  // namespace

Result<TcpListener, std::string> listen_tcp(const Endpoint& at, int backlog) {
    const auto failed = [&at] { return Error{bind_error("tcp", at, errno)}; };
    TcpListener listener{open_socket(), at};
    if (!listener.socket) return failed();
    const int socket = listener.socket.get();
    // Connections of a run before may still be winding down.
    const int on = 1;
    if (::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) != 0) return failed();
    sockaddr_in address = to_sockaddr(at);
    if (::bind(socket, generic(address), sizeof(address)) != 0) return failed();
    if (::listen(socket, backlog) != 0) return failed();
    socklen_t length = sizeof(address);
    if (::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0) return failed();
    listener.local = to_endpoint(address);
    return listener;
}

FileDescriptor accept_tcp(const TcpListener& listener) noexcept {
    return FileDescriptor(::accept4(listener.socket.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
}

Result<FileDescriptor, std::string> connect_tcp(const Endpoint& to, std::chrono::milliseconds limit) {
    FileDescriptor socket = open_socket();
    if (!socket) return Error{words(errno)};
    const sockaddr_in address = to_sockaddr(to);
    if (::connect(socket.get(), generic(address), sizeof(address)) == 0) return socket;
    if (errno != EINPROGRESS) return Error{words(errno)};
    pollfd event{socket.get(), POLLOUT, 0};
    if (::poll(&event, 1, static_cast<int>(limit.count())) == 0) return Error{words(ETIMEDOUT)};
    int error = 0;
    socklen_t length = sizeof(error);
    if (::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &length) != 0) error = errno;
    if (error != 0) return Error{words(error)};
    return socket;
}

}  // namespace skyig::protocol::transport
