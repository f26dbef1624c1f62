#include "server/live_wire.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace skyig::server {

namespace transport = protocol::transport;

namespace {

/// A flood may fill the ring; it may not hold a frame up. A host sends a few kilobytes a frame.
constexpr std::size_t kMostBytesAFrame = std::size_t{512} << 10U;

template <class T>
T value_or_throw(protocol::Result<T, std::string> result) {
    if (!result) throw std::runtime_error(result.error());
    return std::move(result).value();
}

transport::Endpoint endpoint(const config::UdpAddress& address) {
    return {value_or_throw(transport::parse_ipv4(address.address)), address.port};
}

}  // namespace

LiveWire::LiveWire(const config::Config& config) {
    if (config.host.enabled) add(0, config.host.listen, config.host.allow);
    for (std::size_t i = 0; i < config.sources.size(); ++i) {
        const config::Source& source = config.sources[i];
        if (source.kind != config::SourceKind::kCanAerospace) add(i + 1, source.listen, source.allow);
    }
    for (Socket& socket : sockets_)
        open(socket);
}

void LiveWire::add(std::size_t source, const config::UdpAddress& listen,
                   const std::vector<config::UdpAddress>& allow) {
    Listener listener{source, {}};
    for (const config::UdpAddress& sender : allow)
        listener.allow.push_back(endpoint(sender));
    const transport::Endpoint at = endpoint(listen);
    // Port 0 is a new port each time.
    const auto same = std::find_if(sockets_.begin(), sockets_.end(), [&at](const Socket& socket) {
        return at.port != 0 && socket.listen == at;
    });
    Socket& socket = same == sockets_.end() ? sockets_.emplace_back() : *same;
    socket.listen = at;
    socket.listeners.push_back(std::move(listener));
}

void LiveWire::open(Socket& socket) {
    transport::UdpOptions options;
    options.listen = socket.listen;
    for (const Listener& listener : socket.listeners) {
        for (const transport::Endpoint& sender : listener.allow)
            options.allowed.push_back(sender.address);
    }
    socket.receiver = value_or_throw(transport::UdpReceiver::open(options));
    socket.sender = value_or_throw(socket.receiver->make_sender());
}

std::optional<std::size_t> LiveWire::owner(const Socket& socket, const transport::Endpoint& from) noexcept {
    for (const Listener& listener : socket.listeners) {
        for (const transport::Endpoint& sender : listener.allow) {
            if (sender.address == from.address && (sender.port == 0 || sender.port == from.port))
                return listener.source;
        }
    }
    return std::nullopt;
}

void LiveWire::drain(ArrivalTaker& taker) {
    for (Socket& socket : sockets_) {
        socket.receiver->drain(
            [this, &socket, &taker](const transport::Datagram& datagram) {
                if (const auto source = owner(socket, datagram.from)) {
                    taker.take(*source, datagram);
                } else {
                    ++not_allowed_;
                }
            },
            kMostBytesAFrame);
    }
}

bool LiveWire::send(std::size_t source, const transport::Endpoint& to, std::span<const std::byte> bytes) {
    for (Socket& socket : sockets_) {
        for (const Listener& listener : socket.listeners) {
            if (listener.source == source) return socket.sender->send(to, bytes);
        }
    }
    return false;
}

transport::UdpCounters LiveWire::counters() const {
    transport::UdpCounters sum;
    for (const Socket& socket : sockets_) {
        const transport::UdpCounters one = socket.receiver->counters();
        sum.received += one.received;
        sum.received_bytes += one.received_bytes;
        sum.not_allowed += one.not_allowed;
        sum.ring_full += one.ring_full;
        sum.errors += one.errors;
    }
    sum.not_allowed += not_allowed_;
    return sum;
}

const LiveWire::Socket* LiveWire::socket_of(std::size_t source) const noexcept {
    for (const Socket& socket : sockets_) {
        for (const Listener& listener : socket.listeners) {
            if (listener.source == source) return &socket;
        }
    }
    return nullptr;
}

std::optional<transport::Endpoint> LiveWire::local(std::size_t source) const {
    const Socket* socket = socket_of(source);
    if (socket == nullptr) return std::nullopt;
    return socket->receiver->local();
}

}  // namespace skyig::server
