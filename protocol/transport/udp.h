// UDP in and out. The receiver has a thread of its own that takes datagrams with the kernel's time stamps
// into a ring of fixed storage; one consumer drains it without waiting, copying or allocating.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "protocol/result.h"
#include "protocol/transport/datagram_ring.h"
#include "protocol/transport/endpoint.h"
#include "protocol/transport/file_descriptor.h"

namespace skyig::protocol::transport {

struct UdpOptions {
    Endpoint listen;
    /// Who may send; port 0: any of that address. Empty: 127.0.0.0/8, any port.
    std::vector<Endpoint> allowed{};
    /// Room for datagrams that wait for the consumer; brought to a power of two, 256 KiB at least.
    std::size_t ring_bytes = std::size_t{4} << 20U;
    /// How much of a processor the thread may take over time; what comes faster waits in the socket's queue,
    /// and what finds that full is dropped by the kernel. 1: all of it.
    double most_of_processor = 1.0;
};

struct UdpCounters {
    std::uint64_t received = 0;  // put into the ring
    std::uint64_t received_bytes = 0;
    std::uint64_t not_allowed = 0;  // dropped: sender not on the list
    std::uint64_t ring_full = 0;    // dropped: the consumer was too slow
    std::uint64_t queue_full = 0;   // dropped by the kernel: the thread was too slow, or held back
    std::uint64_t errors = 0;       // failed receive calls
};

/// Sends without blocking; never waits for anyone.
class UdpSender {
  public:
    /// A sender with a socket of its own, bound to no fixed port.
    [[nodiscard]] static Result<UdpSender, std::string> open();

    /// False, and counted, if the system did not take the datagram.
    bool send(const Endpoint& to, std::span<const std::byte> bytes) noexcept;

    [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }
    [[nodiscard]] std::uint64_t failed() const noexcept { return failed_; }

  private:
    friend class UdpReceiver;
    explicit UdpSender(FileDescriptor socket) noexcept : socket_(std::move(socket)) {}

    FileDescriptor socket_;
    std::uint64_t sent_ = 0;
    std::uint64_t failed_ = 0;
};

class UdpReceiver {
  public:
    /// Binds and starts the thread. The error is one line: "udp 127.0.0.1:8004: address already in use; ...".
    [[nodiscard]] static Result<UdpReceiver, std::string> open(const UdpOptions& options);
    UdpReceiver(UdpReceiver&&) noexcept;
    UdpReceiver& operator=(UdpReceiver&&) noexcept;
    UdpReceiver(const UdpReceiver&) = delete;
    UdpReceiver& operator=(const UdpReceiver&) = delete;
    /// Stops the thread at once.
    ~UdpReceiver();

    /// Calls `take(const Datagram&)` for each datagram that had come when the call began, oldest first; their
    /// bytes live only as long as that call. One consumer thread. Stops once `most_bytes` have been handed
    /// on; the rest waits. Returns how many.
    template <class Take>
    std::size_t drain(Take&& take, std::size_t most_bytes = std::numeric_limits<std::size_t>::max()) {
        return ring().drain(take, most_bytes);
    }

    /// Waits until a datagram is in the ring or the time is over; true if one is. For consumers without a
    /// frame clock.
    [[nodiscard]] bool wait(std::chrono::milliseconds timeout) noexcept;

    /// While strangers flood the kernel filters them: what it drops meanwhile counts as theirs.
    [[nodiscard]] UdpCounters counters() const noexcept;
    /// Where it listens, with the port that the system chose if 0 was asked for.
    [[nodiscard]] Endpoint local() const noexcept;
    /// A sender that uses this socket: what it sends comes from local().
    [[nodiscard]] Result<UdpSender, std::string> make_sender() const;

  private:
    struct State;
    explicit UdpReceiver(std::unique_ptr<State> state) noexcept;
    [[nodiscard]] DatagramRing& ring() noexcept;

    std::unique_ptr<State> state_;
};

}  // namespace skyig::protocol::transport
