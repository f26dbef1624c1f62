#include "protocol/recording/link_layer.h"

#include <algorithm>
#include <cstring>

namespace skyig::protocol::recording {
namespace {

using Bytes = std::span<const std::byte>;
constexpr ByteOrder kNetwork = ByteOrder::kBig;

// Protocols of Ethernet and of Linux's cooked captures.
constexpr std::uint16_t kProtocolCan = 0x000C;
constexpr std::uint16_t kProtocolCanFd = 0x000D;
constexpr std::uint16_t kProtocolIpv4 = 0x0800;
constexpr std::uint16_t kProtocolIpv6 = 0x86DD;

constexpr std::size_t kEthernetBytes = 14;
constexpr std::size_t kVlanBytes = 4;
constexpr std::size_t kCookedBytes = 16;
constexpr std::size_t kCooked2Bytes = 20;
constexpr std::size_t kLoopbackBytes = 4;
constexpr std::size_t kIpv4Bytes = 20;
constexpr std::size_t kUdpBytes = 8;
constexpr std::uint8_t kUdp = 17;

// SocketCAN's frame: identifier and flags, length, CAN FD flags, two bytes, data.
constexpr std::size_t kCanHeaderBytes = 8;
constexpr std::uint32_t kCanExtended = 0x8000'0000U;
constexpr std::uint32_t kCanRemote = 0x4000'0000U;
constexpr std::uint32_t kCanError = 0x2000'0000U;
constexpr std::uint8_t kCanXl = 0x80;  // in the length byte
constexpr std::uint8_t kCanFdFormat = 0x04;

std::uint16_t word_at(Bytes bytes, std::size_t offset) noexcept {
    return load<std::uint16_t>(bytes.data() + offset, kNetwork);
}

Contents cut(bool whole) noexcept {
    return whole ? Contents::kMalformed : Contents::kCutShort;
}

Contents take_udp(Bytes bytes, std::size_t ip_payload_bytes, bool whole, CapturedPacket& packet) noexcept {
    if (ip_payload_bytes < kUdpBytes) return Contents::kMalformed;
    if (bytes.size() < kUdpBytes) return cut(whole);
    std::size_t length = word_at(bytes, 4);
    if (length == 0) length = ip_payload_bytes;  // a segment that a network card was to divide
    if (length < kUdpBytes || length > ip_payload_bytes) return Contents::kMalformed;
    if (length > bytes.size()) return cut(whole);
    packet.kind = CapturedPacket::Kind::kUdp;
    packet.from.port = word_at(bytes, 0);
    packet.to.port = word_at(bytes, 2);
    packet.payload = bytes.subspan(kUdpBytes, length - kUdpBytes);
    return Contents::kUdp;
}

Contents take_ipv4(Bytes bytes, bool whole, CapturedPacket& packet) noexcept {
    if (bytes.size() < kIpv4Bytes) return cut(whole);
    const auto first = static_cast<std::uint8_t>(bytes[0]);
    const std::size_t header = std::size_t{4} * (first & 0x0FU);
    if (first >> 4U != 4U || header < kIpv4Bytes) return Contents::kMalformed;
    std::size_t total = word_at(bytes, 2);
    if (total == 0) total = bytes.size();  // longer than the field can tell: see take_udp
    if (total < header) return Contents::kMalformed;
    constexpr std::uint16_t kMoreFragmentsOrOffset = 0x3FFF;
    if ((word_at(bytes, 6) & kMoreFragmentsOrOffset) != 0) return Contents::kFragment;
    if (static_cast<std::uint8_t>(bytes[9]) != kUdp) return Contents::kOtherProtocol;
    if (bytes.size() < header) return cut(whole);
    packet.from.address = load<std::uint32_t>(bytes.data() + 12, kNetwork);
    packet.to.address = load<std::uint32_t>(bytes.data() + 16, kNetwork);
    return take_udp(bytes.first(std::min(total, bytes.size())).subspan(header), total - header, whole,
                    packet);
}

Contents take_ip(Bytes bytes, bool whole, CapturedPacket& packet) noexcept {
    if (bytes.empty()) return cut(whole);
    const unsigned version = static_cast<std::uint8_t>(bytes[0]) >> 4U;
    if (version == 6) return Contents::kIpv6;
    return take_ipv4(bytes, whole, packet);
}

Contents take_can(Bytes bytes, bool whole, ByteOrder order, CapturedPacket& packet) noexcept {
    if (bytes.size() < kCanHeaderBytes) return cut(whole);
    const auto word = load<std::uint32_t>(bytes.data(), order);
    const auto length = static_cast<std::uint8_t>(bytes[4]);
    const auto flags = static_cast<std::uint8_t>(bytes[5]);
    if ((length & kCanXl) != 0) return Contents::kOtherProtocol;
    CanFrame frame;
    frame.error = (word & kCanError) != 0;
    frame.remote = !frame.error && (word & kCanRemote) != 0;
    frame.extended = !frame.error && (word & kCanExtended) != 0;
    frame.id = word & kMaxExtendedId;
    frame.length = length;
    // Writers older than the format's flag tell CAN FD by the size of its frame alone.
    frame.fd = !frame.error && ((flags & kCanFdFormat) != 0 || length > kClassicBytes ||
                                bytes.size() == kCanHeaderBytes + kFdBytes);
    if (frame.fd) frame.fd_flags = fd_flags_from(flags);
    const bool wide = frame.extended || frame.error;
    if ((frame.fd && frame.remote) || (!wide && frame.id > kMaxStandardId) ||
        length > (frame.fd ? kFdBytes : kClassicBytes))
        return Contents::kMalformed;
    if (!frame.remote) {
        const Bytes data = bytes.subspan(kCanHeaderBytes);
        if (data.size() < length) return cut(whole);
        if (length > 0) std::memcpy(frame.data.data(), data.data(), length);
    }
    packet.kind = CapturedPacket::Kind::kCan;
    packet.can = frame;
    return Contents::kCan;
}

Contents take_protocol(std::uint16_t protocol, Bytes bytes, bool whole, ByteOrder can_order,
                       CapturedPacket& packet) noexcept {
    switch (protocol) {
        case kProtocolIpv4:
            return take_ipv4(bytes, whole, packet);
        case kProtocolIpv6:
            return Contents::kIpv6;
        case kProtocolCan:
        case kProtocolCanFd:
            return take_can(bytes, whole, can_order, packet);
        default:
            return Contents::kOtherProtocol;
    }
}

bool is_vlan(std::uint16_t protocol) noexcept {
    return protocol == 0x8100 || protocol == 0x88A8 || protocol == 0x9100;
}

Contents take_ethernet(Bytes bytes, bool whole, ByteOrder file_order, CapturedPacket& packet) noexcept {
    if (bytes.size() < kEthernetBytes) return cut(whole);
    std::size_t header = kEthernetBytes;
    while (is_vlan(word_at(bytes, header - 2))) {
        header += kVlanBytes;
        if (bytes.size() < header) return cut(whole);
    }
    return take_protocol(word_at(bytes, header - 2), bytes.subspan(header), whole, file_order, packet);
}

/// The family is in the order of the machine that captured, which the file does not tell.
Contents take_loopback(Bytes bytes, bool whole, CapturedPacket& packet) noexcept {
    if (bytes.size() < kLoopbackBytes) return cut(whole);
    const auto word = load<std::uint32_t>(bytes.data(), kNetwork);
    const std::uint32_t family = word <= 0xFFFF ? word : detail::swapped(word);
    const Bytes rest = bytes.subspan(kLoopbackBytes);
    constexpr std::uint32_t kFamilyIpv4 = 2;
    if (family == kFamilyIpv4) return take_ipv4(rest, whole, packet);
    // The systems number IPv6 as they like.
    constexpr std::uint32_t kFamiliesIpv6[] = {10, 23, 24, 26, 28, 30};
    return std::ranges::find(kFamiliesIpv6, family) != std::end(kFamiliesIpv6) ? Contents::kIpv6
                                                                               : Contents::kOtherProtocol;
}

Contents take_cooked(Bytes bytes, std::size_t header, std::size_t protocol_offset, bool whole,
                     ByteOrder file_order, CapturedPacket& packet) noexcept {
    if (bytes.size() < header) return cut(whole);
    return take_protocol(word_at(bytes, protocol_offset), bytes.subspan(header), whole, file_order, packet);
}

}  // namespace

Contents take_apart(std::uint32_t link_type, std::span<const std::byte> bytes, bool whole,
                    ByteOrder file_order, CapturedPacket& packet) noexcept {
    switch (link_type) {
        case link_type::kNull:
        case link_type::kLoop:
            return take_loopback(bytes, whole, packet);
        case link_type::kEthernet:
            return take_ethernet(bytes, whole, file_order, packet);
        case link_type::kRaw:
        case link_type::kIpv4:
            return take_ip(bytes, whole, packet);
        case link_type::kLinuxCooked:
            return take_cooked(bytes, kCookedBytes, 14, whole, file_order, packet);
        case link_type::kLinuxCooked2:
            return take_cooked(bytes, kCooked2Bytes, 0, whole, file_order, packet);
        case link_type::kSocketCan:
            return take_can(bytes, whole, kNetwork, packet);
        default:
            return Contents::kUnknownLink;
    }
}

}  // namespace skyig::protocol::recording
