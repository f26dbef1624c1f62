// What the daemon tells the service manager that started it: sd_notify(3), lines in a datagram to the socket
// that $NOTIFY_SOCKET names. Without one everything here does nothing.
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/transport/file_descriptor.h"

namespace skyig::server::service {

class ServiceManager {
  public:
    /// Tells nobody.
    ServiceManager() = default;
    /// \param socket_path  a path, or an abstract name that begins with '@'; empty, too long: nobody is told
    /// \param watchdog_ns  within which the manager wants to hear of a frame; 0 = it does not watch
    ServiceManager(std::string_view socket_path, std::int64_t watchdog_ns);

    /// Of $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID, which may name another process.
    [[nodiscard]] static ServiceManager from_environment();

    /// The daemon serves, from now on or again. \param status  one line for people
    void ready(std::string_view status) noexcept;
    /// It reads its settings anew; ready() says that this is over. \param now_ns  CLOCK_MONOTONIC
    void reloading(std::int64_t now_ns) noexcept;
    void stopping() noexcept;

    /// A frame has been drawn; for the frame loop alone, since this and nothing else feeds the watchdog:
    /// every third of its time at most. Neither waits nor allocates.
    void frame_drawn(std::int64_t now_ns) noexcept;
    /// The frame at hand takes as long as a start, since the picture's device is set up anew: until it is
    /// drawn the watchdog waits a minute.
    void frame_takes_long() noexcept;

  private:
    void send(std::string_view lines) noexcept;
    void feed(std::int64_t within_ns) noexcept;

    protocol::transport::FileDescriptor socket_;
    std::int64_t watchdog_ns_ = 0;
    std::int64_t fed_ns_ = 0;
    bool fed_ = false;
    bool long_ = false;
};

}  // namespace skyig::server::service
