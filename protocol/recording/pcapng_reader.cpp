#include "protocol/recording/pcapng_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "protocol/recording/pcapng_blocks.h"

namespace skyig::protocol::recording {
namespace {

namespace block = pcapng::block;
namespace option = pcapng::option;

std::string_view text_of(std::span<const std::byte> bytes) noexcept {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Calls `take(code, value, offset of the value)` for each option between `begin` and the block's end. False,
/// with `at` set, if an option is longer than the block.
template <class Take>
bool for_each_option(std::span<const std::byte> bytes, std::size_t begin, ByteOrder order, std::size_t& at,
                     Take take) {
    const std::size_t end = bytes.size() - pcapng::kTrailerBytes;
    at = begin;
    while (at + pcapng::kOptionHeaderBytes <= end) {
        const auto code = load<std::uint16_t>(bytes.data() + at, order);
        const auto length = load<std::uint16_t>(bytes.data() + at + 2, order);
        if (code == option::kEnd) return true;
        const std::size_t value = at + pcapng::kOptionHeaderBytes;
        if (pcapng::padded(length) > end - value) return false;
        take(code, bytes.subspan(value, length), value);
        at = value + pcapng::padded(length);
    }
    return true;  // the end-of-options mark may be left out
}

bool holds_packet(std::uint32_t type) noexcept {
    return type == block::kEnhancedPacket || type == block::kSimplePacket || type == block::kObsoletePacket;
}

bool is_read(std::uint32_t type) noexcept {
    return holds_packet(type) || type == block::kSection || type == block::kInterface;
}

std::string longer_option(std::size_t at) {
    return fmt::format("the option at byte {} of its block is longer than the block", at);
}

std::string repeated_length(std::uint32_t length) {
    return fmt::format("a block repeats its length at its end: {} is right here", length);
}

constexpr std::string_view kCutOff = "the file ends inside a block; all blocks before it were read";

}  // namespace

Step PcapngReader::damaged(std::uint64_t at, std::string text, Trouble& trouble) const {
    trouble = {block_offset_ + at, std::move(text)};
    return Step::kDamaged;
}

Step PcapngReader::next(ByteWindow& window, RawPacket& packet, Trouble& trouble) {
    block_offset_ = window.offset();
    const Bytes head = window.peek(pcapng::kMinBlockBytes);
    if (head.empty()) return Step::kEnd;
    if (head.size() < pcapng::kMinBlockBytes) {
        trouble = {block_offset_, std::string(kCutOff)};
        return Step::kTruncated;
    }
    if (std::ranges::all_of(head, [](std::byte each) { return each == std::byte{}; })) {
        trouble = {block_offset_,
                   "zeros where a block should be: the end of a file that was not written out"};
        return Step::kTruncated;
    }
    const auto type = load<std::uint32_t>(head.data(), order_);
    if (type == block::kSection && begin_section_order(head, trouble) == Step::kDamaged)
        return Step::kDamaged;
    const auto length = load<std::uint32_t>(head.data() + 4, order_);
    if (length < pcapng::kMinBlockBytes || length % 4 != 0)
        return damaged(4, fmt::format("block length {}; a multiple of 4 from 12 on", length), trouble);
    if (!is_read(type)) return pass_over(window, length, trouble);
    if (length > ByteWindow::kBytes) {
        if (!holds_packet(type))
            return damaged(4, fmt::format("header of {} bytes; {} at most", length, ByteWindow::kBytes),
                           trouble);
        const Step step = pass_over(window, length, trouble);
        return step == Step::kOther ? Step::kOversized : step;
    }
    const Bytes bytes = window.peek(length);
    if (bytes.size() < length) {
        trouble = {block_offset_, std::string(kCutOff)};
        return Step::kTruncated;
    }
    if (load<std::uint32_t>(bytes.data() + length - pcapng::kTrailerBytes, order_) != length)
        return damaged(length - pcapng::kTrailerBytes, repeated_length(length), trouble);
    const Step step = read_block(type, bytes, packet, trouble);
    if (step != Step::kDamaged) window.skip(length);
    return step;
}

Step PcapngReader::pass_over(ByteWindow& window, std::uint32_t length, Trouble& trouble) {
    const std::uint64_t body = length - pcapng::kTrailerBytes;
    const bool whole = window.skip(body) == body;
    const Bytes trailer = window.peek(pcapng::kTrailerBytes);
    if (!whole || trailer.size() < pcapng::kTrailerBytes) {
        trouble = {block_offset_, std::string(kCutOff)};
        return Step::kTruncated;
    }
    if (load<std::uint32_t>(trailer.data(), order_) != length)
        return damaged(body, repeated_length(length), trouble);
    window.skip(pcapng::kTrailerBytes);
    return Step::kOther;
}

/// A section may be in another byte order than the one before it.
Step PcapngReader::begin_section_order(Bytes head, Trouble& trouble) {
    const std::byte* magic = head.data() + pcapng::kBodyOffset;
    for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
        if (load<std::uint32_t>(magic, order) != pcapng::kByteOrderMagic) continue;
        order_ = order;
        return Step::kOther;
    }
    return damaged(pcapng::kBodyOffset,
                   fmt::format("byte-order mark {:08X}; 1A2B3C4D or 4D3C2B1A",
                               load<std::uint32_t>(magic, ByteOrder::kBig)),
                   trouble);
}

Step PcapngReader::read_block(std::uint32_t type, Bytes bytes, RawPacket& packet, Trouble& trouble) {
    switch (type) {
        case block::kSection:
            return read_section(bytes, trouble);
        case block::kInterface:
            return read_interface(bytes, trouble);
        case block::kSimplePacket:
            return read_simple_packet(bytes, packet, trouble);
        default:
            break;
    }
    if (bytes.size() < pcapng::kPacketData + pcapng::kTrailerBytes)
        return damaged(4, fmt::format("packet block of {} bytes; 32 at least", bytes.size()), trouble);
    const std::byte* interface = bytes.data() + pcapng::kBodyOffset;
    return read_packet(bytes,
                       type == block::kEnhancedPacket ? load<std::uint32_t>(interface, order_)
                                                      : load<std::uint16_t>(interface, order_),
                       packet, trouble);
}

Step PcapngReader::read_section(Bytes bytes, Trouble& trouble) {
    if (bytes.size() < pcapng::kSectionOptions + pcapng::kTrailerBytes)
        return damaged(4, fmt::format("section header of {} bytes; 28 at least", bytes.size()), trouble);
    const auto major = load<std::uint16_t>(bytes.data() + 12, order_);
    if (major != 1) return damaged(12, fmt::format("pcapng version {}; 1 is read", major), trouble);
    first_interface_ += static_cast<std::uint32_t>(interfaces_.size());
    interfaces_.clear();
    can_interfaces_ = 0;
    section_comment_.clear();
    bool first = true;
    std::size_t at = 0;
    const auto keep = [&](std::uint16_t code, Bytes value, std::size_t /*offset*/) {
        if (code != option::kComment) return;
        if (!first) section_comment_ += '\n';
        first = false;
        section_comment_ += text_of(value);
    };
    if (!for_each_option(bytes, pcapng::kSectionOptions, order_, at, keep))
        return damaged(at, longer_option(at), trouble);
    return Step::kOther;
}

Step PcapngReader::read_interface(Bytes bytes, Trouble& trouble) {
    if (bytes.size() < pcapng::kInterfaceOptions + pcapng::kTrailerBytes)
        return damaged(4, fmt::format("interface block of {} bytes; 20 at least", bytes.size()), trouble);
    if (interfaces_.size() == kMaxInterfaces)
        return damaged(0, fmt::format("more than {} interfaces in a section", kMaxInterfaces), trouble);
    CaptureInterface added;
    added.link_type = load<std::uint16_t>(bytes.data() + pcapng::kBodyOffset, order_);
    added.snap_length = load<std::uint32_t>(bytes.data() + pcapng::kBodyOffset + 4, order_);
    std::size_t at = 0;
    std::size_t bad_unit = 0;
    const auto keep = [&](std::uint16_t code, Bytes value, std::size_t offset) {
        if (code == option::kInterfaceName)
            added.name = text_of(value.first(std::min<std::size_t>(value.size(), 64)));
        if (code == option::kStampOffset && value.size() == sizeof(std::int64_t))
            added.unit.offset_s = load<std::int64_t>(value.data(), order_);
        if (code != option::kStampResolution || value.empty()) return;
        const auto word = static_cast<std::uint8_t>(value[0]);
        added.unit.binary = (word & 0x80U) != 0;
        added.unit.exponent = static_cast<std::uint8_t>(word & 0x7FU);
        if (added.unit.exponent > (added.unit.binary ? 63 : 19)) bad_unit = offset;
    };
    if (!for_each_option(bytes, pcapng::kInterfaceOptions, order_, at, keep))
        return damaged(at, longer_option(at), trouble);
    if (bad_unit != 0)
        return damaged(bad_unit,
                       fmt::format("time resolution {}^-{}; 10^0 to 10^-19, or 2^0 to 2^-63",
                                   added.unit.binary ? 2 : 10, added.unit.exponent),
                       trouble);
    if (added.link_type == link_type::kSocketCan) {
        added.bus = can_interfaces_;
        if (can_interfaces_ < std::numeric_limits<std::uint8_t>::max()) ++can_interfaces_;
    }
    interfaces_.push_back(std::move(added));
    return Step::kOther;
}

bool PcapngReader::find_interface(std::uint32_t interface, std::size_t at, RawPacket& packet,
                                  Trouble& trouble) const {
    if (interface >= interfaces_.size()) {
        static_cast<void>(damaged(at,
                                  fmt::format("packet of interface {}; its section has described {} so far",
                                              interface, interfaces_.size()),
                                  trouble));
        return false;
    }
    packet.interface = first_interface_ + interface;
    packet.origin = &interfaces_[interface];
    packet.file_order = order_;
    packet.offset_bytes = block_offset_;
    return true;
}

Step PcapngReader::read_packet(Bytes bytes, std::uint32_t interface, RawPacket& packet, Trouble& trouble) {
    if (!find_interface(interface, pcapng::kBodyOffset, packet, trouble)) return Step::kDamaged;
    const auto captured = load<std::uint32_t>(bytes.data() + 20, order_);
    const std::size_t room = bytes.size() - pcapng::kPacketData - pcapng::kTrailerBytes;
    if (captured > room)
        return damaged(20, fmt::format("{} captured bytes in a block with room for {}", captured, room),
                       trouble);
    const std::uint64_t high = load<std::uint32_t>(bytes.data() + 12, order_);
    const std::uint64_t ticks = high << 32U | load<std::uint32_t>(bytes.data() + 16, order_);
    packet.time_ns = to_ns(packet.origin->unit, ticks);
    packet.stamped = true;
    last_time_ns_ = packet.time_ns;
    packet.original_bytes = load<std::uint32_t>(bytes.data() + 24, order_);
    packet.bytes = bytes.subspan(pcapng::kPacketData, captured);
    packet.comment = {};
    std::size_t at = 0;
    const auto keep = [&](std::uint16_t code, Bytes value, std::size_t /*offset*/) {
        if (code == option::kComment && packet.comment.empty()) packet.comment = text_of(value);
    };
    if (!for_each_option(bytes, pcapng::kPacketData + pcapng::padded(captured), order_, at, keep))
        return damaged(at, longer_option(at), trouble);
    return Step::kPacket;
}

Step PcapngReader::read_simple_packet(Bytes bytes, RawPacket& packet, Trouble& trouble) {
    if (bytes.size() < pcapng::kSimplePacketData + pcapng::kTrailerBytes)
        return damaged(4, fmt::format("simple packet block of {} bytes; 16 at least", bytes.size()), trouble);
    if (!find_interface(0, 0, packet, trouble)) return Step::kDamaged;
    const auto original = load<std::uint32_t>(bytes.data() + pcapng::kBodyOffset, order_);
    const std::uint32_t limit = packet.origin->snap_length;
    const std::size_t captured = limit == 0 ? original : std::min(original, limit);
    const std::size_t room = bytes.size() - pcapng::kSimplePacketData - pcapng::kTrailerBytes;
    if (captured > room)
        return damaged(pcapng::kBodyOffset,
                       fmt::format("{} captured bytes in a block with room for {}", captured, room), trouble);
    packet.time_ns = last_time_ns_;
    packet.stamped = false;
    packet.original_bytes = original;
    packet.bytes = bytes.subspan(pcapng::kSimplePacketData, captured);
    packet.comment = {};
    return Step::kPacket;
}

}  // namespace skyig::protocol::recording
