// Any bytes as a message in either direction: no read outside them, nothing but finite numbers delivered,
// what was accepted is accepted again as it is, and what is written from a decoded packet reads back.
#include <array>
#include <cmath>
#include <cstdlib>

#include "protocol/cigi/catalogue.h"
#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"
#include "protocol/cigi/message.h"

namespace skyig::protocol::cigi {
namespace {

void require(bool kept) {
    if (!kept) std::abort();
}

/// Watches the walk of one message, with or without validation.
struct Check {
    template <class P>
    void operator()(const P& packet, const PacketInfo& info) {
        follow(info);
        if (validated) {
            visit_fields(packet, info.version, [](std::string_view /*name*/, const auto& value) {
                if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>)
                    require(std::isfinite(value));
            });
            P again = packet;
            const Verdict verdict = validate(again, info.version);
            require(verdict.accepted && !verdict.clamped);
        }
        MessageWriter writer(buffer, info.version, info.order);
        if (!writer.add(packet)) return;  // only a text can be longer than the buffer
        P read;
        require(read_packet(writer.bytes(), info.version, info.order, read));
    }
    void skipped(const PacketInfo& info) {
        follow(info);
        require(!listed_packet_name(info.version, info.id).empty());
    }
    void refused(const RefusedPacket& packet, const PacketInfo& info) {
        follow(info);
        require(validated && !packet.field.empty());
    }
    void passed_over(const RefusedPacket& packet, const PacketInfo& info) {
        follow(info);
        require(packet.kind < kPacketKinds && packet.field.empty());
    }
    /// Packets come one after another, without a gap.
    void follow(const PacketInfo& info) {
        require(info.offset == end);
        end = info.offset + info.bytes.size();
    }

    bool validated = true;
    std::size_t end = 0;
    std::array<std::byte, 4096> buffer{};
};

template <class Decode>
void watch(Decode decode, std::span<const std::byte> bytes, Validation validation) {
    Check check;
    check.validated = validation == Validation::kOn;
    Counters counters;
    const MessageSummary summary = decode(bytes, check, counters, validation);
    require(summary.accepted ? check.end == (summary.fault ? summary.offset : bytes.size()) : check.end == 0);
    require(summary.accepted || summary.fault);
}

}  // namespace
}  // namespace skyig::protocol::cigi

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skyig::protocol::cigi;
    const auto bytes = std::as_bytes(std::span(data, size));
    const auto host = [](auto&&... all) { return decode_host_message(all...); };
    const auto ig = [](auto&&... all) { return decode_ig_message(all...); };
    for (const Validation validation : {Validation::kOn, Validation::kOff}) {
        watch(host, bytes, validation);
        watch(ig, bytes, validation);
    }
    return 0;
}
