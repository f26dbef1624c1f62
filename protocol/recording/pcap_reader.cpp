#include "protocol/recording/pcap_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace skyig::protocol::recording {
namespace {

constexpr std::uint32_t kMicroseconds = 0xA1B2C3D4;
constexpr std::uint32_t kNanoseconds = 0xA1B23C4D;
constexpr std::size_t kMagicBytes = 4;
constexpr std::size_t kFileHeaderBytes = 24;
constexpr std::size_t kRecordHeaderBytes = 16;
constexpr std::uint32_t kLinkTypeBits = 0x0FFF'FFFF;  // above them: what is known of checksums

bool is_magic(std::uint32_t word) noexcept {
    return word == kMicroseconds || word == kNanoseconds;
}

Step truncated(std::uint64_t at, std::string text, Trouble& trouble) {
    trouble = {at, std::move(text)};
    return Step::kTruncated;
}

}  // namespace

bool PcapReader::recognises(std::span<const std::byte> head) noexcept {
    return head.size() >= kMagicBytes && (is_magic(load<std::uint32_t>(head.data(), ByteOrder::kLittle)) ||
                                          is_magic(load<std::uint32_t>(head.data(), ByteOrder::kBig)));
}

Step PcapReader::read_header(ByteWindow& window, Trouble& trouble) {
    const auto head = window.peek(kFileHeaderBytes);
    if (head.size() < kFileHeaderBytes)
        return truncated(0, "the file ends inside its header of 24 bytes", trouble);
    order_ =
        is_magic(load<std::uint32_t>(head.data(), ByteOrder::kLittle)) ? ByteOrder::kLittle : ByteOrder::kBig;
    const auto major = load<std::uint16_t>(head.data() + 4, order_);
    if (major != 2) {
        trouble = {4, fmt::format("pcap version {}; 2 is read", major)};
        return Step::kDamaged;
    }
    interface_.unit.exponent = load<std::uint32_t>(head.data(), order_) == kNanoseconds ? 9 : 6;
    interface_.snap_length = load<std::uint32_t>(head.data() + 16, order_);
    interface_.link_type = load<std::uint32_t>(head.data() + 20, order_) & kLinkTypeBits;
    header_read_ = true;
    window.skip(kFileHeaderBytes);
    return Step::kOther;
}

Step PcapReader::next(ByteWindow& window, RawPacket& packet, Trouble& trouble) {
    if (!header_read_) return read_header(window, trouble);
    const std::uint64_t offset = window.offset();
    const auto head = window.peek(kRecordHeaderBytes);
    if (head.empty()) return Step::kEnd;
    if (head.size() < kRecordHeaderBytes)
        return truncated(offset, "the file ends inside a record; all records before it were read", trouble);
    if (std::ranges::all_of(head, [](std::byte each) { return each == std::byte{}; }))
        return truncated(offset, "zeros where a record should be: the end of a file that was not written out",
                         trouble);
    const std::uint64_t seconds = load<std::uint32_t>(head.data(), order_);
    const std::uint64_t fraction = load<std::uint32_t>(head.data() + 4, order_);
    const auto captured = load<std::uint32_t>(head.data() + 8, order_);
    packet.original_bytes = load<std::uint32_t>(head.data() + 12, order_);
    if (captured > kMaxPacketBytes) {
        trouble = {offset + 8, fmt::format("{} captured bytes; {} at most", captured, kMaxPacketBytes)};
        return Step::kDamaged;
    }
    const auto record = window.peek(kRecordHeaderBytes + captured);
    if (record.size() < kRecordHeaderBytes + captured)
        return truncated(offset, "the file ends inside a record; all records before it were read", trouble);
    const std::uint64_t ticks_per_second = interface_.unit.exponent == 9 ? 1'000'000'000 : 1'000'000;
    packet.time_ns = to_ns(interface_.unit, seconds * ticks_per_second + fraction);
    packet.stamped = true;
    packet.offset_bytes = offset;
    packet.interface = 0;
    packet.origin = &interface_;
    packet.bytes = record.subspan(kRecordHeaderBytes);
    packet.comment = {};
    packet.file_order = order_;
    window.skip(record.size());
    return Step::kPacket;
}

}  // namespace skyig::protocol::recording
