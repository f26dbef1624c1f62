// Any bytes as a capture, pcapng or pcap: no read outside them, every packet counted once, and what was read
// writes and reads back the same.
#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

#include "protocol/recording/capture_reader.h"
#include "protocol/recording/pcapng_writer.h"

namespace skyig::protocol::recording {
namespace {

std::uint64_t parts(const CaptureCounters& counters) {
    return counters.udp + counters.can + counters.fragments + counters.ipv6 + counters.other_protocols +
           counters.unknown_link + counters.cut_short + counters.malformed + counters.oversized;
}

std::optional<PcapngWriter> begin_copy(std::vector<std::byte>& copy) {
    auto writer = PcapngWriter::begin(
        [&copy](std::span<const std::byte> blocks) {
            copy.insert(copy.end(), blocks.begin(), blocks.end());
            return true;
        },
        {.can_names = {"can0", "can1"}});
    if (!writer) std::abort();
    return std::move(*writer);
}

/// What the copy has room for.
bool goes_along(const CapturedPacket& packet) {
    return packet.payload.size() <= PcapngWriter::kMaxPayloadBytes &&
           (packet.kind == CapturedPacket::Kind::kUdp || packet.can.bus < 2);
}

void write(PcapngWriter& writer, const CapturedPacket& packet) {
    const bool written = packet.kind == CapturedPacket::Kind::kUdp
                             ? writer.write_udp(packet.time_ns, packet.from, packet.to, packet.payload)
                             : writer.write_can(packet.can);
    if (written != goes_along(packet)) std::abort();
}

void compare(std::span<const std::byte> bytes, const std::vector<std::byte>& copy) {
    auto first = CaptureReader::over(bytes, "first");
    auto second = CaptureReader::over(copy, "second");
    if (!first || !second) std::abort();
    while (const CapturedPacket* packet = first->next()) {
        if (!goes_along(*packet)) continue;
        const CapturedPacket* again = second->next();
        if (again == nullptr || again->kind != packet->kind) std::abort();
        if (packet->time_ns >= 0 && again->time_ns != packet->time_ns) std::abort();
        if (packet->kind == CapturedPacket::Kind::kUdp) {
            if (!(again->from == packet->from) || !(again->to == packet->to)) std::abort();
            if (!std::equal(packet->payload.begin(), packet->payload.end(), again->payload.begin(),
                            again->payload.end()))
                std::abort();
        } else if (packet->time_ns >= 0 && !(again->can == packet->can)) {
            std::abort();
        }
    }
    if (second->next() != nullptr || second->end() != CaptureReader::End::kComplete) std::abort();
}

}  // namespace
}  // namespace skyig::protocol::recording

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skyig::protocol::recording;
    const auto bytes = std::as_bytes(std::span(data, size));
    auto reader = CaptureReader::over(bytes, "input");
    if (!reader) return 0;
    std::vector<std::byte> copy;
    auto writer = begin_copy(copy);
    while (const CapturedPacket* packet = reader->next())
        write(*writer, *packet);
    const CaptureCounters& counters = reader->counters();
    if (counters.packets != parts(counters) || reader->end() == CaptureReader::End::kNotYet) std::abort();
    compare(bytes, copy);
    return 0;
}
