// The sockets of all sources: where each is heard, and whose a datagram is; the buses that are listened to.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "protocol/transport/can_socket.h"
#include "server/kernel_stamps.h"
#include "server/log.h"
#include "server/report.h"
#include "server/wire.h"

namespace skyig::server {

/// Sources of one address and port share a socket; a datagram there belongs to the first of them that allows
/// its sender. A bus need not be there: its interface is waited for, and what becomes of it is told from
/// drain(), so by the frame loop's thread. Without a bus in the settings nothing of CAN is touched.
class LiveWire final : public Wire {
  public:
    /// Clock and log must outlive the wire; arrivals are handed on as of the clock's steady UTC. \throws
    /// std::runtime_error with one line when a socket cannot be had
    LiveWire(const config::Config& config, const Clock& clock, Log& log);

    void open_frame(const FrameMark& /*mark*/, std::span<const std::byte> /*message*/) override {}
    void drain(ArrivalTaker& taker) override;
    [[nodiscard]] bool wait(std::size_t source, std::int64_t most_ns) override;
    [[nodiscard]] bool live() const noexcept override { return true; }
    bool send(std::size_t source, const protocol::transport::Endpoint& to,
              std::span<const std::byte> bytes) override;
    [[nodiscard]] protocol::transport::UdpCounters counters() const override;

    /// Where a source is heard; nothing if it has no socket.
    [[nodiscard]] std::optional<protocol::transport::Endpoint> local(std::size_t source) const;

    /// The bus of a source, or null.
    [[nodiscard]] const protocol::transport::CanReceiver* bus(std::size_t source) const noexcept;
    /// From any thread.
    [[nodiscard]] std::vector<BusRow> bus_rows() const;

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

    struct Bus {
        std::size_t source = 0;
        /// Of the source, for the log.
        std::string name;
        protocol::transport::CanReceiver receiver;
        /// What has been told.
        protocol::transport::CanState state;
        protocol::transport::CanCounters counters;
    };

    void add_bus(std::size_t source, const config::Source& settings);
    void tell_steps();
    void tell(Bus& bus);
    void tell_losses(const Bus& bus, const protocol::transport::CanCounters& now);
    void add(std::size_t source, const config::UdpAddress& listen,
             const std::vector<config::UdpAddress>& allow);
    static void open(Socket& socket);
    [[nodiscard]] const Socket* socket_of(std::size_t source) const noexcept;
    [[nodiscard]] Socket* socket_of(std::size_t source) noexcept;
    [[nodiscard]] static std::optional<std::size_t> owner(const Socket& socket,
                                                          const protocol::transport::Endpoint& from) noexcept;

    Log& log_;
    KernelStamps stamps_;
    std::uint64_t told_steps_ = 0;
    std::vector<Socket> sockets_;
    std::vector<Bus> buses_;
    /// Datagrams of an allowed address from a port that no source allows.
    std::uint64_t not_allowed_ = 0;
};

}  // namespace skyig::server
