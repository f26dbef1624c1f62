// What a datagram is: version and byte order from its first packet, or why it is no CIGI message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/cigi/counters.h"
#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

struct MessageSummary {
    bool accepted = false;
    Version version = Version::k33;
    ByteOrder order = kNativeOrder;
    /// Why the datagram was dropped (kShort .. kBadMagic), or why the walk ended early (kBadSize,
    /// kTruncated).
    std::optional<Count> fault;
    /// Byte of the datagram where the fault lies; the datagram's length if there is none.
    std::uint32_t offset = 0;
};

namespace detail {

// Both directions begin with a packet of 24 bytes; 3.x carries the magic at byte 6.
inline constexpr std::size_t kFirstPacketBytes = 24;
inline constexpr unsigned kOldFirstPacketBytes = 16;  // IG Control and Start of Frame of 3.0 and 3.1
inline constexpr std::size_t kMagicOffset = 6;
inline constexpr std::uint16_t kSwappedMagic = 0x0080;
inline constexpr unsigned kMajor33 = 3;
inline constexpr unsigned kMajor40 = 4;

/// What a message of one direction begins with: the first byte in 3.x, the id in 4.0 (the same in both
/// orders).
struct FirstPacket {
    unsigned start33;
    std::uint16_t id40;
};
inline constexpr FirstPacket kFromHost{1, 0x0000};
inline constexpr FirstPacket kFromIg{101, 0xFFFF};

// These fill a summary in place: a copy of so small a struct just after its bytes were written costs more
// than all the rest.

inline void drop(Count fault, std::size_t offset, MessageSummary& summary) noexcept {
    summary.fault = fault;
    summary.offset = static_cast<std::uint32_t>(offset);
}

inline void accept(Version version, ByteOrder order, MessageSummary& summary) noexcept {
    summary.accepted = true;
    summary.version = version;
    summary.order = order;
}

/// The first packet has the 3.x id.
inline void detect_33(std::span<const std::byte> bytes, MessageSummary& summary) noexcept {
    const auto size = std::to_integer<unsigned>(bytes[1]);
    const auto major = std::to_integer<unsigned>(bytes[2]);
    if (size == kFirstPacketBytes && major == kMajor33) {
        const auto magic = load<std::uint16_t>(bytes.data() + kMagicOffset, ByteOrder::kBig);
        if (magic == kByteSwapMagic) return accept(Version::k33, ByteOrder::kBig, summary);
        if (magic == kSwappedMagic) return accept(Version::k33, ByteOrder::kLittle, summary);
        return drop(Count::kBadMagic, kMagicOffset, summary);
    }
    const bool older = major == 1 || major == 2 || (major == kMajor33 && size == kOldFirstPacketBytes);
    if (older || size == kFirstPacketBytes) return drop(Count::kBadVersion, 2, summary);
    return drop(Count::kFirstPacket, 0, summary);
}

/// `summary` is as it was made.
inline void detect(std::span<const std::byte> bytes, const FirstPacket& first,
                   MessageSummary& summary) noexcept {
    summary.offset = static_cast<std::uint32_t>(bytes.size());
    if (bytes.size() < kFirstPacketBytes) return drop(Count::kShort, bytes.size(), summary);
    if (std::to_integer<unsigned>(bytes[0]) == first.start33) return detect_33(bytes, summary);
    const auto size = load<std::uint16_t>(bytes.data(), ByteOrder::kLittle);
    const bool little = size == kFirstPacketBytes;
    const bool big = size == kFirstPacketBytes << 8U;
    if ((little || big) && load<std::uint16_t>(bytes.data() + 2, ByteOrder::kLittle) == first.id40) {
        if (std::to_integer<unsigned>(bytes[4]) != kMajor40) return drop(Count::kBadVersion, 4, summary);
        return accept(Version::k40, little ? ByteOrder::kLittle : ByteOrder::kBig, summary);
    }
    return drop(Count::kFirstPacket, 0, summary);
}

}  // namespace detail

/// Version and order of a host-to-IG (IG-to-host) datagram from its first packet; counts nothing.
[[nodiscard]] inline MessageSummary detect_host_message(std::span<const std::byte> bytes) noexcept {
    MessageSummary summary;
    detail::detect(bytes, detail::kFromHost, summary);
    return summary;
}
[[nodiscard]] inline MessageSummary detect_ig_message(std::span<const std::byte> bytes) noexcept {
    MessageSummary summary;
    detail::detect(bytes, detail::kFromIg, summary);
    return summary;
}

}  // namespace skyig::protocol::cigi
