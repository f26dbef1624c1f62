// All that passes between the frame loop and the world outside, whatever carries it: sockets, a recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/can_frame.h"
#include "protocol/transport/datagram_ring.h"
#include "protocol/transport/endpoint.h"
#include "protocol/transport/udp.h"

namespace skyig::server {

/// Hears what has come, in the order in which it came. `source` is its place in the settings: 0 the host,
/// then the [[source]] tables. What is handed over lives as long as the call.
class ArrivalTaker {
  public:
    ArrivalTaker() = default;
    ArrivalTaker(const ArrivalTaker&) = delete;
    ArrivalTaker& operator=(const ArrivalTaker&) = delete;
    ArrivalTaker(ArrivalTaker&&) = delete;
    ArrivalTaker& operator=(ArrivalTaker&&) = delete;
    virtual ~ArrivalTaker() = default;

    virtual void take(std::size_t source, const protocol::transport::Datagram& datagram) = 0;
    virtual void take(std::size_t source, const protocol::CanFrame& frame) = 0;
};

/// A frame as it begins: with what came before it, all that a recording needs to run it again.
struct FrameMark {
    std::uint64_t number = 0;
    /// Steps of the frame rate's grid since the frame before.
    std::uint64_t slots = 0;
    /// What it leaves out, by the numbers of render::Thin.
    std::uint64_t thinned = 0;
    /// Clock::steady_utc_ns().
    std::int64_t utc_ns = 0;
};

class Wire {
  public:
    Wire() = default;
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;
    Wire(Wire&&) = delete;
    Wire& operator=(Wire&&) = delete;
    virtual ~Wire() = default;

    /// A frame begins. `message` is what opens it towards the host, sent or not.
    virtual void open_frame(const FrameMark& mark, std::span<const std::byte> message) = 0;
    /// Hands on what has come, oldest first; what is more than a frame can take waits for the next. Waits for
    /// nothing, allocates nothing.
    virtual void drain(ArrivalTaker& taker) = 0;
    /// Waits until something of that source has come that drain() has not handed on, for `most_ns` at most.
    /// \return whether it has; at once and false where nothing more can come
    [[nodiscard]] virtual bool wait(std::size_t /*source*/, std::int64_t /*most_ns*/) { return false; }
    /// Whether arrivals are stamped by this machine's clock, now.
    [[nodiscard]] virtual bool live() const noexcept { return false; }
    /// False when the system did not take it.
    virtual bool send(std::size_t source, const protocol::transport::Endpoint& to,
                      std::span<const std::byte> bytes) = 0;
    /// Of all UDP sources together.
    [[nodiscard]] virtual protocol::transport::UdpCounters counters() const = 0;
};

}  // namespace skyig::server
