// What one thread tells another through a file descriptor, so that it can be waited for beside sockets.
#pragma once

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>

#include "protocol/transport/file_descriptor.h"

namespace skyig::protocol::transport {

class EventSignal {
  public:
    /// False when the system had none to give; errno says why.
    EventSignal() noexcept : event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
    [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(event_); }

    void raise() noexcept {
        const std::uint64_t one = 1;
        // Fails only when the counter is full, that is, when it is raised already.
        [[maybe_unused]] const ssize_t written = ::write(event_.get(), &one, sizeof(one));
    }

    /// For poll(): POLLIN while it is raised.
    [[nodiscard]] pollfd watched() const noexcept { return {event_.get(), POLLIN, 0}; }

    /// Waits until there is something or the time is over; true if `has_something()` in the end. It has to
    /// hold before the signal is raised.
    template <class HasSomething>
    [[nodiscard]] bool wait(std::chrono::milliseconds timeout, HasSomething&& has_something) noexcept {
        // Cleared before the look: what comes after the look raises it again.
        lower();
        if (has_something()) return true;
        pollfd event = watched();
        ::poll(&event, 1, static_cast<int>(timeout.count()));
        lower();
        return has_something();
    }

  private:
    void lower() noexcept {
        std::uint64_t raised = 0;
        [[maybe_unused]] const ssize_t cleared = ::read(event_.get(), &raised, sizeof(raised));
    }

    FileDescriptor event_;
};

}  // namespace skyig::protocol::transport
