#include "protocol/recording/pcapng_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "protocol/byte_order.h"
#include "protocol/recording/capture.h"
#include "protocol/recording/pcapng_blocks.h"

namespace skyig::protocol::recording {
namespace {

namespace block = pcapng::block;
namespace option = pcapng::option;
using Bytes = std::span<const std::byte>;

constexpr ByteOrder kFile = kNativeOrder;
constexpr ByteOrder kNetwork = ByteOrder::kBig;
constexpr std::size_t kIpv4Bytes = 20;
constexpr std::size_t kUdpBytes = 8;
constexpr std::size_t kCanHeaderBytes = 8;
constexpr std::size_t kMaxOptionBytes = 65'532;  // so that the padded length fits 16 bits, too
constexpr std::uint8_t kNanoseconds = 9;
constexpr std::uint8_t kUdp = 17;

template <class T>
void append(std::vector<std::byte>& out, T value) {
    out.resize(out.size() + sizeof(T));
    store(out.data() + out.size() - sizeof(T), kFile, value);
}

void append_option(std::vector<std::byte>& out, std::uint16_t code, Bytes value) {
    append(out, code);
    append(out, static_cast<std::uint16_t>(value.size()));
    out.insert(out.end(), value.begin(), value.end());
    out.resize(pcapng::padded(out.size()));
}

/// Opens a block; close_block() gives it its length.
std::size_t open_block(std::vector<std::byte>& out, std::uint32_t type) {
    const std::size_t begin = out.size();
    append(out, type);
    append(out, std::uint32_t{0});
    return begin;
}

void close_block(std::vector<std::byte>& out, std::size_t begin) {
    append(out, std::uint32_t{option::kEnd});
    const auto length = static_cast<std::uint32_t>(out.size() - begin + pcapng::kTrailerBytes);
    append(out, length);
    store(out.data() + begin + 4, kFile, length);
}

/// The longest beginning of `text` that is at most `most` bytes and ends between two UTF-8 characters.
std::string_view cut(std::string_view text, std::size_t most) noexcept {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
        --end;
    return text.substr(0, end == 0 ? most : end);
}

/// A text too long for one option goes into several, divided between lines where that is possible: readers
/// join them with a line feed.
void append_comments(std::vector<std::byte>& out, std::string_view text) {
    while (text.size() > kMaxOptionBytes) {
        const std::size_t line_end = text.rfind('\n', kMaxOptionBytes);
        const bool at_line = line_end != std::string_view::npos;
        const std::string_view part = at_line ? text.substr(0, line_end) : cut(text, kMaxOptionBytes);
        append_option(out, option::kComment, std::as_bytes(std::span(part)));
        text.remove_prefix(part.size() + (at_line ? 1 : 0));
    }
    if (!text.empty()) append_option(out, option::kComment, std::as_bytes(std::span(text)));
}

void append_section(std::vector<std::byte>& out, const RecordingHead& head) {
    const std::size_t begin = open_block(out, block::kSection);
    append(out, pcapng::kByteOrderMagic);
    append(out, std::uint16_t{1});
    append(out, std::uint16_t{0});
    append(out, std::int64_t{-1});  // length of the section: not known
    append_comments(out, head.comment);
    append_option(out, option::kSectionProgram, std::as_bytes(std::span(head.program)));
    close_block(out, begin);
}

void append_interface(std::vector<std::byte>& out, std::uint32_t link_type, const std::string& name) {
    const std::size_t begin = open_block(out, block::kInterface);
    append(out, static_cast<std::uint16_t>(link_type));
    append(out, std::uint16_t{0});
    append(out, std::uint32_t{0});  // captured without a limit
    append_option(out, option::kInterfaceName, std::as_bytes(std::span(name)));
    const std::byte resolution{kNanoseconds};
    append_option(out, option::kStampResolution, std::span(&resolution, 1));
    close_block(out, begin);
}

/// The sum of big-endian 16-bit words that both checksums are the complement of, not yet folded.
std::uint64_t sum_words(Bytes bytes) noexcept {
    // Words are summed as they lie and the sum is turned once: ones' complement sums allow both that and
    // summing four at a time (RFC 1071).
    std::uint64_t sum = 0;
    std::size_t at = 0;
    for (; at + 4 <= bytes.size(); at += 4)
        sum += load<std::uint32_t>(bytes.data() + at, kNativeOrder);
    std::uint32_t rest = 0;
    if (at < bytes.size()) std::memcpy(&rest, bytes.data() + at, bytes.size() - at);
    return sum + rest;
}

/// The complement of the sum, as it is to lie in memory.
std::uint16_t checksum(std::uint64_t sum) noexcept {
    while (sum > 0xFFFF)
        sum = (sum & 0xFFFFU) + (sum >> 16U);
    return static_cast<std::uint16_t>(~sum);
}

/// IPv4 header, UDP header and the payload behind them, both checksums right.
void put_datagram(std::byte* at, const transport::Endpoint& from, const transport::Endpoint& to,
                  Bytes payload) noexcept {
    const std::size_t udp_bytes = kUdpBytes + payload.size();
    store(at, kNetwork, std::uint16_t{0x4500});
    store(at + 2, kNetwork, static_cast<std::uint16_t>(kIpv4Bytes + udp_bytes));
    store(at + 4, kNetwork, std::uint32_t{0x4000});  // no identification, not to be fragmented
    store(at + 8, kNetwork, static_cast<std::uint32_t>(64U << 24U | std::uint32_t{kUdp} << 16U));
    store(at + 12, kNetwork, from.address);
    store(at + 16, kNetwork, to.address);
    store(at + 10, kNativeOrder, checksum(sum_words({at, kIpv4Bytes})));

    std::byte* udp = at + kIpv4Bytes;
    store(udp, kNetwork, from.port);
    store(udp + 2, kNetwork, to.port);
    store(udp + 4, kNetwork, static_cast<std::uint16_t>(udp_bytes));
    store(udp + 6, kNetwork, std::uint16_t{0});
    if (!payload.empty()) std::memcpy(udp + kUdpBytes, payload.data(), payload.size());
    std::array<std::byte, 4> protocol_and_length{};
    protocol_and_length[1] = std::byte{kUdp};
    store(protocol_and_length.data() + 2, kNetwork, static_cast<std::uint16_t>(udp_bytes));
    const std::uint16_t sum =
        checksum(sum_words({at + 12, 8}) + sum_words(protocol_and_length) + sum_words({udp, udp_bytes}));
    store(udp + 6, kNativeOrder, sum == 0 ? std::uint16_t{0xFFFF} : sum);  // 0 would mean: not computed
}

/// Returns how many bytes it put.
std::size_t put_can(std::byte* at, const CanFrame& frame) noexcept {
    constexpr std::uint32_t kExtended = 0x8000'0000U;
    constexpr std::uint32_t kRemote = 0x4000'0000U;
    constexpr std::uint32_t kError = 0x2000'0000U;
    std::uint32_t word = frame.id & kMaxExtendedId;
    if (frame.extended) word |= kExtended;
    if (frame.remote) word |= kRemote;
    if (frame.error) word |= kError;
    const std::size_t most = frame.fd ? kFdBytes : kClassicBytes;
    const std::size_t length = std::min<std::size_t>(frame.length, most);
    const std::size_t data = frame.remote ? 0 : length;
    std::memset(at, 0, kCanHeaderBytes);
    store(at, kNetwork, word);
    at[4] = static_cast<std::byte>(length);
    if (frame.fd) at[5] = std::byte{fd_flags_from(frame.fd_flags)};
    std::memcpy(at + kCanHeaderBytes, frame.data.data(), data);
    return kCanHeaderBytes + data;
}

/// The longest block of a packet: headers, payload, comment, end of options, length.
constexpr std::size_t kMaxBlockBytes =
    pcapng::kPacketData + pcapng::padded(kIpv4Bytes + kUdpBytes + PcapngWriter::kMaxPayloadBytes) +
    pcapng::kOptionHeaderBytes + pcapng::padded(PcapngWriter::kMaxPacketCommentBytes) +
    pcapng::kOptionHeaderBytes + pcapng::kTrailerBytes;

}  // namespace

PcapngWriter::PcapngWriter(BlockSink sink, std::size_t can_interfaces)
    : sink_(std::move(sink)), block_(kMaxBlockBytes), can_interfaces_(can_interfaces) {}

Result<PcapngWriter, std::string> PcapngWriter::begin(BlockSink sink, const RecordingHead& head) {
    if (head.comment.size() > kMaxCommentBytes)
        return Error{fmt::format("the recording's comment has {} bytes; {} at most", head.comment.size(),
                                 kMaxCommentBytes)};
    constexpr std::size_t kMaxBuses = 256;
    if (head.can_names.size() > kMaxBuses)
        return Error{fmt::format("{} CAN buses; {} at most", head.can_names.size(), kMaxBuses)};
    std::vector<std::string> names = head.can_names;
    names.push_back(head.udp_name);
    names.push_back(head.program);
    for (const std::string& name : names)
        if (name.size() > kMaxNameBytes)
            return Error{
                fmt::format("the name \"{}\" has {} bytes; {} at most", name, name.size(), kMaxNameBytes)};
    std::vector<std::byte> blocks;
    append_section(blocks, head);
    append_interface(blocks, link_type::kRaw, head.udp_name);
    for (const std::string& name : head.can_names)
        append_interface(blocks, link_type::kSocketCan, name);
    PcapngWriter writer(std::move(sink), head.can_names.size());
    if (!writer.sink_(blocks)) return Error{std::string("the recording's header could not be written")};
    writer.written_bytes_ = blocks.size();
    return writer;
}

bool PcapngWriter::write_udp(std::int64_t time_ns, const transport::Endpoint& from,
                             const transport::Endpoint& to, std::span<const std::byte> payload,
                             std::string_view comment) {
    if (payload.size() > kMaxPayloadBytes) return refuse();
    put_datagram(block_.data() + pcapng::kPacketData, from, to, payload);
    return finish_packet(0, time_ns, kIpv4Bytes + kUdpBytes + payload.size(), comment);
}

bool PcapngWriter::write_can(const CanFrame& frame, std::string_view comment) {
    if (frame.bus >= can_interfaces_) return refuse();
    const std::size_t captured = put_can(block_.data() + pcapng::kPacketData, frame);
    return finish_packet(std::uint32_t{1} + frame.bus, frame.received_ns, captured, comment);
}

/// Puts the block round the packet's bytes and hands it on.
bool PcapngWriter::finish_packet(std::uint32_t interface, std::int64_t time_ns, std::size_t captured,
                                 std::string_view comment) {
    std::byte* const bytes = block_.data();
    std::size_t end = pcapng::kPacketData + pcapng::padded(captured);
    std::memset(bytes + pcapng::kPacketData + captured, 0, pcapng::padded(captured) - captured);
    if (!comment.empty()) {
        comment = cut(comment, kMaxPacketCommentBytes);
        const std::size_t padding = pcapng::padded(comment.size()) - comment.size();
        store(bytes + end, kFile, option::kComment);
        store(bytes + end + 2, kFile, static_cast<std::uint16_t>(comment.size()));
        end += pcapng::kOptionHeaderBytes;
        std::memcpy(bytes + end, comment.data(), comment.size());
        std::memset(bytes + end + comment.size(), 0, padding);
        end += comment.size() + padding;
        store(bytes + end, kFile, std::uint32_t{option::kEnd});
        end += pcapng::kOptionHeaderBytes;
    }
    const auto length = static_cast<std::uint32_t>(end + pcapng::kTrailerBytes);
    const auto ticks = static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
    store(bytes, kFile, block::kEnhancedPacket);
    store(bytes + 4, kFile, length);
    store(bytes + 8, kFile, interface);
    store(bytes + 12, kFile, static_cast<std::uint32_t>(ticks >> 32U));
    store(bytes + 16, kFile, static_cast<std::uint32_t>(ticks & 0xFFFF'FFFFU));
    store(bytes + 20, kFile, static_cast<std::uint32_t>(captured));
    store(bytes + 24, kFile, static_cast<std::uint32_t>(captured));
    store(bytes + end, kFile, length);
    if (!sink_({bytes, length})) return refuse();
    ++written_;
    written_bytes_ += length;
    return true;
}

bool PcapngWriter::refuse() noexcept {
    ++refused_;
    return false;
}

}  // namespace skyig::protocol::recording
