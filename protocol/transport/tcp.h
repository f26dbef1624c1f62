// TCP sockets: one that listens, one that has connected. None of them ever blocks.
#pragma once

#include <chrono>
#include <string>

#include "protocol/result.h"
#include "protocol/transport/endpoint.h"
#include "protocol/transport/file_descriptor.h"

namespace skyig::protocol::transport {

struct TcpListener {
    FileDescriptor socket;
    /// With the port that the system chose if 0 was asked for.
    Endpoint local;
};

/// \param backlog  connections that the system keeps until they are accepted. The error is one line: "tcp
/// 127.0.0.1:8006: address already in use; ..."
[[nodiscard]] Result<TcpListener, std::string> listen_tcp(const Endpoint& at, int backlog);

/// A connection that waits, or an empty descriptor when there is none; errno says why.
[[nodiscard]] FileDescriptor accept_tcp(const TcpListener& listener) noexcept;

/// Waits up to `limit` for the other side. The error is a few words: "nobody listens there".
[[nodiscard]] Result<FileDescriptor, std::string> connect_tcp(const Endpoint& to,
                                                              std::chrono::milliseconds limit);

}  // namespace skyig::protocol::transport
