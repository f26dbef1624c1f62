// The two ways between the frame loop and the host, whatever carries them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "protocol/transport/datagram_ring.h"
#include "protocol/transport/endpoint.h"
#include "protocol/transport/udp.h"

namespace skyig::server {

class DatagramTaker {
  public:
    DatagramTaker() = default;
    DatagramTaker(const DatagramTaker&) = delete;
    DatagramTaker& operator=(const DatagramTaker&) = delete;
    DatagramTaker(DatagramTaker&&) = delete;
    DatagramTaker& operator=(DatagramTaker&&) = delete;
    virtual ~DatagramTaker() = default;

    /// The bytes live as long as the call.
    virtual void take(const protocol::transport::Datagram& datagram) = 0;
};

class HostLink {
  public:
    HostLink() = default;
    HostLink(const HostLink&) = delete;
    HostLink& operator=(const HostLink&) = delete;
    HostLink(HostLink&&) = delete;
    HostLink& operator=(HostLink&&) = delete;
    virtual ~HostLink() = default;

    /// Hands on the datagrams that have come, oldest first; what is more than a frame can take waits for the
    /// next. Waits for nothing, allocates nothing.
    virtual void drain(DatagramTaker& taker) = 0;
    /// False when the system did not take it.
    virtual bool send(const protocol::transport::Endpoint& to, std::span<const std::byte> bytes) = 0;
    [[nodiscard]] virtual protocol::transport::UdpCounters counters() const = 0;
};

/// One UDP socket, in and out.
class UdpLink final : public HostLink {
  public:
    UdpLink(protocol::transport::UdpReceiver receiver, protocol::transport::UdpSender sender)
        : receiver_(std::move(receiver)), sender_(std::move(sender)) {}

    void drain(DatagramTaker& taker) override {
        // A flood may fill the ring; it may not hold a frame up. A host sends a few kilobytes a frame.
        constexpr std::size_t kMostBytesAFrame = std::size_t{512} << 10U;
        receiver_.drain([&taker](const protocol::transport::Datagram& datagram) { taker.take(datagram); },
                        kMostBytesAFrame);
    }
    bool send(const protocol::transport::Endpoint& to, std::span<const std::byte> bytes) override {
        return sender_.send(to, bytes);
    }
    [[nodiscard]] protocol::transport::UdpCounters counters() const override { return receiver_.counters(); }
    [[nodiscard]] protocol::transport::Endpoint local() const { return receiver_.local(); }

  private:
    protocol::transport::UdpReceiver receiver_;
    protocol::transport::UdpSender sender_;
};

}  // namespace skyig::server
