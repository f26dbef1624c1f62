#include "server/service/service_manager.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace skyig::server::service {
namespace {

constexpr std::int64_t kNsPerUs = 1000;
constexpr std::int64_t kLongFrame_ns = 60'000'000'000;

using protocol::transport::FileDescriptor;

/// A datagram socket connected to that of the manager, if there is one.
FileDescriptor connect_to(std::string_view path) noexcept {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof(address.sun_path)) return {};
    std::memcpy(address.sun_path, path.data(), path.size());
    // Abstract names begin with a NUL and have none at their end.
    if (path.front() == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size() +
                                             (path.front() == '@' ? 0U : 1U));
    FileDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (!socket || ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0) return {};
    return socket;
}

/// 0 where the variable is not there or no number.
std::int64_t number_of(const char* variable) noexcept {
    const char* const text = std::getenv(variable);
    std::int64_t number = 0;
    if (text != nullptr) std::from_chars(text, text + std::strlen(text), number);
    return number;
}

}  // namespace

ServiceManager::ServiceManager(std::string_view socket_path, std::int64_t watchdog_ns)
    : socket_(connect_to(socket_path)), watchdog_ns_(watchdog_ns) {}

ServiceManager ServiceManager::from_environment() {
    const char* const path = std::getenv("NOTIFY_SOCKET");
    if (path == nullptr) return {};
    const std::int64_t watched = number_of("WATCHDOG_PID");
    const bool ours = watched == 0 || watched == ::getpid();
    return {path, ours ? number_of("WATCHDOG_USEC") * kNsPerUs : 0};
}

// A datagram that the manager cannot take now is lost: the frame loop never waits for it.
void ServiceManager::send(std::string_view lines) noexcept {
    if (!socket_) return;
    (void)::send(socket_.get(), lines.data(), lines.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

void ServiceManager::ready(std::string_view status) noexcept {
    std::array<char, 512> lines{};
    const auto end = fmt::format_to_n(lines.data(), lines.size(), "READY=1\nSTATUS={}", status);
    send({lines.data(), std::min(end.size, lines.size())});
}

void ServiceManager::reloading(std::int64_t now_ns) noexcept {
    std::array<char, 64> lines{};
    const auto end =
        fmt::format_to_n(lines.data(), lines.size(), "RELOADING=1\nMONOTONIC_USEC={}", now_ns / kNsPerUs);
    send({lines.data(), std::min(end.size, lines.size())});
}

void ServiceManager::stopping() noexcept {
    send("STOPPING=1");
}

void ServiceManager::frame_drawn(std::int64_t now_ns) noexcept {
    if (watchdog_ns_ <= 0 || (!long_ && fed_ && now_ns - fed_ns_ < watchdog_ns_ / 3)) return;
    fed_ = true;
    fed_ns_ = now_ns;
    if (std::exchange(long_, false)) {
        feed(watchdog_ns_);
    } else {
        send("WATCHDOG=1");
    }
}

void ServiceManager::frame_takes_long() noexcept {
    if (watchdog_ns_ <= 0 || std::exchange(long_, true)) return;
    feed(std::max(watchdog_ns_, kLongFrame_ns));
}

/// \param within_ns  when the next is due
void ServiceManager::feed(std::int64_t within_ns) noexcept {
    std::array<char, 64> lines{};
    const auto end =
        fmt::format_to_n(lines.data(), lines.size(), "WATCHDOG=1\nWATCHDOG_USEC={}", within_ns / kNsPerUs);
    send({lines.data(), std::min(end.size, lines.size())});
}

}  // namespace skyig::server::service
