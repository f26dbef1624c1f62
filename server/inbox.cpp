#include "server/inbox.h"

#include <concepts>

#include "protocol/cigi/message.h"
#include "server/endpoint_format.h"

namespace skyig::server {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;

/// Hands the packets of one message to the world and sees what passes by.
class Inbox::Handler {
  public:
    Handler(Inbox& inbox, std::size_t source, const transport::Datagram& datagram)
        : inbox_(inbox), source_(source), from_(datagram.from), arrival_ns_(datagram.arrival_ns) {
        inbox_.world_.begin_message(source, from_);
    }

    template <class P>
    requires std::invocable<world::World&, const P&> ||
        std::invocable<world::World&, const P&, const cigi::PacketInfo&>
    void operator()(const P& packet, const cigi::PacketInfo& info) {
        if constexpr (std::invocable<world::World&, const P&, const cigi::PacketInfo&>) {
            inbox_.world_(packet, info);
        } else {
            inbox_.world_(packet);
        }
        if constexpr (std::same_as<P, cigi::IgControl>) note_control(packet);
    }

    void refused(const cigi::RefusedPacket& packet, const cigi::PacketInfo& info) {
        const char* const fault =
            packet.reason == cigi::Count::kNonfinite ? "not a finite number" : "out of range";
        inbox_.log_.limited({"packet refused", source_}, kRepeatAfter_s, Severity::kWarning,
                            "host {}: {} at byte {} of a message ignored: {} is {}", from_,
                            cigi::packet_name(packet.kind), info.offset, packet.field, fault);
        inbox_.world_.outbox().messages.add(world::Matter::kPacketRefused, "{} at byte {}: {} is {}",
                                            cigi::packet_name(packet.kind), info.offset, packet.field, fault);
    }

    void passed_over(const cigi::RefusedPacket& packet, const cigi::PacketInfo& info) {
        const bool duplicate = packet.reason == cigi::Count::kDuplicateIgControl;
        inbox_.log_.limited(
            {duplicate ? "IG Control again" : "packet of a wrong size", source_}, kRepeatAfter_s,
            Severity::kWarning, "host {}: {} of {} bytes at byte {} ignored: {}", from_,
            cigi::packet_name(packet.kind), info.bytes.size(), info.offset, cigi::count_text(packet.reason));
        inbox_.world_.outbox().messages.add(world::Matter::kPacketRefused, "{} at byte {}: {}",
                                            cigi::packet_name(packet.kind), info.offset,
                                            cigi::count_text(packet.reason));
    }

  private:
    void note_control(const cigi::IgControl& control) {
        if (!inbox_.world_.from_obeyed_host()) return;
        inbox_.frame_arrivals_.add({control.host_frame_number, arrival_ns_});
        inbox_.host_timing_.heard(control, arrival_ns_);
        inbox_.last_echo_ = control.last_ig_frame_number;
        // A host that has not heard of us yet echoes 0: no lag can be told from that.
        if (control.last_ig_frame_number == 0) return;
        inbox_.frames_behind_.add(inbox_.world_.session().round_trip_frames());
    }

    Inbox& inbox_;
    std::size_t source_;
    transport::Endpoint from_;
    std::int64_t arrival_ns_;
};

Inbox::Inbox(const config::Config& config, world::World& world, Log& log)
    : world_(world),
      log_(log),
      arrivals_(config.sources.size() + 1),
      buses_(config.sources.size() + 1),
      flight_models_(config.sources.size() + 1) {
    for (std::size_t i = 0; i < config.sources.size(); ++i) {
        const config::Source& source = config.sources[i];
        if (source.kind == config::SourceKind::kCanAerospace)
            buses_[i + 1] = std::make_unique<BusInput>(i + 1, identifier_map(source), world);
        if (source.kind == config::SourceKind::kFgNetFdm)
            flight_models_[i + 1] = std::make_unique<FlightGearInput>(i + 1, world, log);
    }
}

void Inbox::take(std::size_t source, const transport::Datagram& datagram) {
    ++datagrams_;
    ++arrivals_[source];
    frame_arrivals_.add(datagram.arrival_ns);
    if (flight_models_[source]) {
        flight_models_[source]->take(datagram);
    } else {
        take_message(source, datagram);
    }
}

void Inbox::take_message(std::size_t source, const transport::Datagram& datagram) {
    const cigi::MessageSummary summary =
        cigi::decode_host_message(datagram.bytes, Handler(*this, source, datagram), counters_);
    if (!summary.fault) return;
    if (summary.accepted) {
        world_.outbox().messages.add(world::Matter::kMessageCut, "message ignored from byte {} on: {}",
                                     summary.offset, cigi::count_text(*summary.fault));
        log_.limited({"message cut short", source}, kRepeatAfter_s, Severity::kWarning,
                     "host {}: message ignored from byte {} on: {}", datagram.from, summary.offset,
                     cigi::count_text(*summary.fault));
    } else {
        log_.limited({"datagram dropped", source}, kRepeatAfter_s, Severity::kWarning,
                     "datagram of {} bytes from {} dropped: {}", datagram.bytes.size(), datagram.from,
                     cigi::count_text(*summary.fault));
    }
}

void Inbox::take(std::size_t source, const protocol::CanFrame& frame) {
    ++arrivals_[source];
    frame_arrivals_.add(frame.received_ns);
    if (buses_[source]) buses_[source]->take(frame);
}

}  // namespace skyig::server
