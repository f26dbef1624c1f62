// The sockets of all sources: where each is heard, and whose a datagram is.
#pragma once

#include <optional>
#include <vector>

#include "config/config.h"
#include "server/wire.h"

namespace skyig::server {

/// Sources of one address and port share a socket; a datagram there belongs to the first of them that allows
/// its sender.
class LiveWire final : public Wire {
  public:
    /// \throws std::runtime_error with one line when a socket cannot be had
    explicit LiveWire(const config::Config& config);

    void open_frame(const FrameMark& /*mark*/, std::span<const std::byte> /*message*/) override {}
    void drain(ArrivalTaker& taker) override;
    bool send(std::size_t source, const protocol::transport::Endpoint& to,
              std::span<const std::byte> bytes) override;
    [[nodiscard]] protocol::transport::UdpCounters counters() const override;

    /// Where a source is heard; nothing if it has no socket.
    [[nodiscard]] std::optional<protocol::transport::Endpoint> local(std::size_t source) const;

  private:
    struct Listener {
        std::size_t source = 0;
        /// Port 0: any.
        std::vector<protocol::transport::Endpoint> allow;
    };
    struct Socket {
        protocol::transport::Endpoint listen;
        std::vector<Listener> listeners;
        std::optional<protocol::transport::UdpReceiver> receiver;
        std::optional<protocol::transport::UdpSender> sender;
    };

    void add(std::size_t source, const config::UdpAddress& listen,
             const std::vector<config::UdpAddress>& allow);
    static void open(Socket& socket);
    [[nodiscard]] const Socket* socket_of(std::size_t source) const noexcept;
    [[nodiscard]] static std::optional<std::size_t> owner(const Socket& socket,
                                                          const protocol::transport::Endpoint& from) noexcept;

    std::vector<Socket> sockets_;
    /// Datagrams of an allowed address from a port that no source allows.
    std::uint64_t not_allowed_ = 0;
};

}  // namespace skyig::server
