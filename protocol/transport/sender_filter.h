// Who may send to a socket: looked up here, and, while strangers flood, by the kernel before they cost
// anything.
#pragma once

#include <linux/filter.h>

#include <cstdint>
#include <mutex>
#include <vector>

#include "protocol/transport/endpoint.h"

namespace skyig::protocol::transport {

class SenderFilter {
  public:
    /// \param allowed  port 0: any port of that address; empty: any port of 127.0.0.0/8
    explicit SenderFilter(std::vector<Endpoint> allowed);

    [[nodiscard]] bool allows(const Endpoint& from) const noexcept;

    /// The kernel drops what allows() refuses as it comes, on the sender's time where sender and receiver
    /// share a machine: it takes no room in the socket's queue and wakes nobody, and is counted by
    /// KernelDrops alone. False if the kernel does not take the program; nothing is then changed.
    [[nodiscard]] bool attach(int socket) noexcept;
    static void detach(int socket) noexcept;

  private:
    std::vector<Endpoint> allowed_;
    std::vector<sock_filter> program_;
};

/// Datagrams that the kernel has dropped for one socket. It keeps one count for all reasons: while the filter
/// is on they are taken for strangers', else for such as found the socket's queue full. Safe from several
/// threads; to be looked at once in 2^32 datagrams.
class KernelDrops {
  public:
    struct Counts {
        std::uint64_t strangers = 0;
        std::uint64_t queue_full = 0;
    };

    explicit KernelDrops(int socket) noexcept;

    /// The filter has just been attached, or is about to be detached.
    void set_filtering(bool on) noexcept;
    [[nodiscard]] Counts counts() noexcept;

  private:
    void add_new() noexcept;

    int socket_;
    std::mutex mutex_;
    std::uint32_t seen_;
    bool filtering_ = false;
    Counts counts_;
};

}  // namespace skyig::protocol::transport
