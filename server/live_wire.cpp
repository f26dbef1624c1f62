#include "server/live_wire.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

namespace skyig::server {

namespace transport = protocol::transport;

namespace {

/// A flood may fill the ring; it may not hold a frame up. A host sends a few kilobytes a frame.
constexpr std::size_t kMostBytesAFrame = std::size_t{512} << 10U;
/// Of each socket's thread: some twenty thousand datagrams a second, of which a host sends 60.
constexpr double kMostOfProcessor = 0.03;
/// Half a second of a full bus.
constexpr std::size_t kMostBusFramesAFrame = 4096;

template <class T>
T value_or_throw(protocol::Result<T, std::string> result) {
    if (!result) throw std::runtime_error(result.error());
    return std::move(result).value();
}

transport::Endpoint endpoint(const config::UdpAddress& address) {
    return {value_or_throw(transport::parse_ipv4(address.address)), address.port};
}

}  // namespace

LiveWire::LiveWire(const config::Config& config, const Clock& clock, Log& log) : log_(log), stamps_(clock) {
    if (config.host.enabled) add(0, config.host.listen, config.host.allow);
    for (std::size_t i = 0; i < config.sources.size(); ++i) {
        const config::Source& source = config.sources[i];
        if (source.kind == config::SourceKind::kCanAerospace) {
            add_bus(i + 1, source);
        } else {
            add(i + 1, source.listen, source.allow);
        }
    }
    for (Socket& socket : sockets_)
        open(socket);
}

void LiveWire::add_bus(std::size_t source, const config::Source& settings) {
    transport::CanOptions options;
    options.interface = settings.interface;
    options.bus = static_cast<std::uint8_t>(source);
    auto receiver = transport::CanReceiver::open(options);
    if (!receiver) throw std::runtime_error(fmt::format("source {}: {}", settings.name, receiver.error()));
    // The start line tells how it stands; from here on changes are told.
    const transport::CanState state = receiver->state();
    buses_.push_back({source, settings.name, std::move(*receiver), state, {}});
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
    options.most_of_processor = kMostOfProcessor;
    for (const Listener& listener : socket.listeners) {
        for (const transport::Endpoint& sender : listener.allow)
            options.allowed.push_back(sender);
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
    stamps_.look();
    tell_steps();
    for (Socket& socket : sockets_) {
        socket.receiver->drain(
            [this, &socket, &taker](const transport::Datagram& datagram) {
                if (const auto source = owner(socket, datagram.from)) {
                    taker.take(*source,
                               {datagram.from, stamps_.steady_ns(datagram.arrival_ns), datagram.bytes});
                } else {
                    ++not_allowed_;
                }
            },
            kMostBytesAFrame);
    }
    for (Bus& bus : buses_) {
        bus.receiver.drain(
            [this, &bus, &taker](protocol::CanFrame frame) {
                frame.received_ns = stamps_.steady_ns(frame.received_ns);
                taker.take(bus.source, frame);
            },
            kMostBusFramesAFrame);
        tell(bus);
    }
}

void LiveWire::tell_steps() {
    if (stamps_.steps() == told_steps_) return;
    told_steps_ = stamps_.steps();
    log_.limited(
        "clock set", 60.0, Severity::kNotice,
        "the system's clock was set by {:+.3f} s: world time, frames and delays go on as if it had not been",
        static_cast<double>(stamps_.last_step_ns()) * 1e-9);
}

/// Down and up again, or gone and back, between two looks is told too: the bus was silent meanwhile.
void LiveWire::tell(Bus& bus) {
    // In this order: what is counted is then not of a state still to come.
    const transport::CanCounters now = bus.receiver.counters();
    const transport::CanState state = bus.receiver.state();
    const bool interrupted =
        now.went_down != bus.counters.went_down || now.went_away != bus.counters.went_away;
    const std::string& interface = bus.receiver.interface();
    if (state != bus.state || (interrupted && state == transport::CanState::kUp)) {
        switch (state) {
            case transport::CanState::kUp:
                log_.notice("source {}: listening on {}{}", bus.name, interface,
                            state == bus.state ? ", which was away for a moment" : "");
                break;
            case transport::CanState::kDown:
                log_.warning("source {}: {} is down; waiting until it is up (ip link set {} up)", bus.name,
                             interface, interface);
                break;
            case transport::CanState::kMissing:
                log_.warning("source {}: {} is gone; looking for it once a second", bus.name, interface);
                break;
        }
    }
    tell_losses(bus, now);
    bus.state = state;
    bus.counters = now;
}

void LiveWire::tell_losses(const Bus& bus, const transport::CanCounters& now) {
    if (now.dropped != bus.counters.dropped) {
        log_.limited({"bus dropped", bus.source}, kRepeatAfter_s, Severity::kWarning,
                     "source {}: the system dropped {} frames of {} so far: they came faster than they were "
                     "read (net.core.rmem_max sets how many may wait)",
                     bus.name, now.dropped, bus.receiver.interface());
    }
    if (now.ring_full != bus.counters.ring_full) {
        log_.limited({"bus ring full", bus.source}, kRepeatAfter_s, Severity::kWarning,
                     "source {}: {} frames of {} dropped so far: they came faster than frames take them",
                     bus.name, now.ring_full, bus.receiver.interface());
    }
}

const transport::CanReceiver* LiveWire::bus(std::size_t source) const noexcept {
    const auto bus =
        std::find_if(buses_.begin(), buses_.end(), [source](const Bus& one) { return one.source == source; });
    return bus == buses_.end() ? nullptr : &bus->receiver;
}

std::vector<BusRow> LiveWire::bus_rows() const {
    std::vector<BusRow> rows;
    for (const Bus& bus : buses_) {
        const transport::CanCounters counters = bus.receiver.counters();
        rows.push_back({bus.name,
                        bus.receiver.interface(),
                        std::string(transport::to_text(bus.receiver.state())),
                        {{"received", counters.received},
                         {"fd_frames", counters.fd_frames},
                         {"error_frames", counters.error_frames},
                         {"dropped", counters.dropped},
                         {"ring_full", counters.ring_full},
                         {"went_down", counters.went_down},
                         {"went_away", counters.went_away},
                         {"opened", counters.opened},
                         {"errors", counters.errors}}});
    }
    return rows;
}

bool LiveWire::send(std::size_t source, const transport::Endpoint& to, std::span<const std::byte> bytes) {
    Socket* socket = socket_of(source);
    return socket != nullptr && socket->sender->send(to, bytes);
}

transport::UdpCounters LiveWire::counters() const {
    transport::UdpCounters sum;
    for (const Socket& socket : sockets_) {
        const transport::UdpCounters one = socket.receiver->counters();
        sum.received += one.received;
        sum.received_bytes += one.received_bytes;
        sum.not_allowed += one.not_allowed;
        sum.ring_full += one.ring_full;
        sum.queue_full += one.queue_full;
        sum.errors += one.errors;
    }
    sum.not_allowed += not_allowed_;
    return sum;
}

LiveWire::Socket* LiveWire::socket_of(std::size_t source) noexcept {
    for (Socket& socket : sockets_) {
        for (const Listener& listener : socket.listeners) {
            if (listener.source == source) return &socket;
        }
    }
    return nullptr;
}

const LiveWire::Socket* LiveWire::socket_of(std::size_t source) const noexcept {
    return const_cast<LiveWire*>(this)->socket_of(source);
}

bool LiveWire::wait(std::size_t source, std::int64_t most_ns) {
    Socket* socket = socket_of(source);
    if (socket == nullptr) return false;
    const auto most = std::chrono::ceil<std::chrono::milliseconds>(std::chrono::nanoseconds(most_ns));
    return socket->receiver->wait(most);
}

std::optional<transport::Endpoint> LiveWire::local(std::size_t source) const {
    const Socket* socket = socket_of(source);
    if (socket == nullptr) return std::nullopt;
    return socket->receiver->local();
}

}  // namespace skyig::server
