// What one link has received and refused, by name. One Counters belongs to one source.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/cigi/packet_list.h"

namespace skyig::protocol::cigi {

/// The first four drop the datagram; the next two end the walk and keep the packets before; the others
/// concern one packet each.
enum class Count : std::uint8_t {
    kShort,        // fewer than 24 bytes
    kFirstPacket,  // the first packet is not IG Control (host to IG) or Start of Frame (IG to host)
    kBadVersion,   // a CIGI that is neither 3.2/3.3 nor 4.x
    kBadMagic,     // 3.3: byte_swap is neither order of 0x8000
    kBadSize,      // a packet states a size smaller than its header
    kTruncated,    // a packet reaches beyond the datagram, or a header is cut
    kWrongSize,    // known id, size other than its table's
    kSkipped,      // id unknown here, skipped by its size
    kNonfinite,    // a NaN or an infinity in a field that counts
    kOutOfRange,
    kClamped,  // packets accepted after a percentage (or a corner radius) was brought into its range
    kDuplicateIgControl,
    kDuplicateStartOfFrame,
    kEnd
};

inline constexpr std::size_t kCounts = static_cast<std::size_t>(Count::kEnd);

/// "short", "first_packet", ... as the metrics and logs show them.
[[nodiscard]] std::string_view count_name(Count count) noexcept;
/// One plain sentence: what was wrong and what would be right.
[[nodiscard]] std::string_view count_text(Count count) noexcept;
/// "ig_control", ...; kind < kPacketKinds.
[[nodiscard]] std::string_view packet_name(std::size_t kind) noexcept;

struct Counters {
    /// Datagrams whose framing was accepted.
    std::uint64_t messages = 0;
    std::array<std::uint64_t, kCounts> counts{};
    /// Packets handed on, by kPacketKind.
    std::array<std::uint64_t, kPacketKinds> packets{};

    [[nodiscard]] std::uint64_t& operator[](Count count) noexcept {
        return counts[static_cast<std::size_t>(count)];
    }
    [[nodiscard]] std::uint64_t operator[](Count count) const noexcept {
        return counts[static_cast<std::size_t>(count)];
    }
    template <class P>
    [[nodiscard]] std::uint64_t packets_of() const noexcept {
        return packets[kPacketKind<P>];
    }
};

}  // namespace skyig::protocol::cigi
