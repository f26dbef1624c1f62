// What a capture file holds for us: UDP datagrams and CAN frames, with the time and place of their capture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/can_frame.h"
#include "protocol/transport/endpoint.h"

namespace skyig::protocol::recording {

/// Link-layer types of www.tcpdump.org/linktypes.html that are taken apart.
namespace link_type {
inline constexpr std::uint32_t kNull = 0;  // BSD loopback
inline constexpr std::uint32_t kEthernet = 1;
inline constexpr std::uint32_t kRaw = 101;  // IPv4 or IPv6 without anything before it
inline constexpr std::uint32_t kLoop = 108;
inline constexpr std::uint32_t kLinuxCooked = 113;
inline constexpr std::uint32_t kSocketCan = 227;
inline constexpr std::uint32_t kIpv4 = 228;
inline constexpr std::uint32_t kLinuxCooked2 = 276;
}  // namespace link_type

/// How a file counts time: a tick is 10^-exponent or 2^-exponent seconds.
struct StampUnit {
    std::uint8_t exponent = 6;
    bool binary = false;
    /// Added to every stamp.
    std::int64_t offset_s = 0;
};

/// Nanoseconds since 1970, cut off below; held at the ends of the type for stamps beyond the years
/// 1678..2262.
[[nodiscard]] std::int64_t to_ns(const StampUnit& unit, std::uint64_t ticks) noexcept;

struct CaptureInterface {
    std::uint32_t link_type = 0;
    /// Captured bytes of a packet at most; 0: no limit.
    std::uint32_t snap_length = 0;
    StampUnit unit;
    /// Its number among the CAN interfaces of its section, 255 at most; 0 if it is none.
    std::uint8_t bus = 0;
    /// "can0", "lo"; empty if the file does not tell.
    std::string name;
};

struct CapturedPacket {
    enum class Kind : std::uint8_t { kUdp, kCan };
    Kind kind = Kind::kUdp;
    /// False for a block without a stamp: time_ns is then that of the packet before it.
    bool stamped = true;
    /// Nanoseconds since 1970-01-01 UTC.
    std::int64_t time_ns = 0;
    /// UDP only.
    transport::Endpoint from;
    transport::Endpoint to;
    std::span<const std::byte> payload;
    /// CAN only; received_ns is time_ns, bus that of the interface.
    CanFrame can;
    /// The packet's first comment, or empty.
    std::string_view comment;
    /// Counted on over the file's sections.
    std::uint32_t interface = 0;
    /// Among all packets of the file from 1, as Wireshark numbers them.
    std::uint64_t number = 0;
    /// Where its block or record begins in the file.
    std::uint64_t offset_bytes = 0;
};

/// What became of the packets of a file; every one is counted in exactly one of the members after `packets`.
struct CaptureCounters {
    std::uint64_t packets = 0;
    std::uint64_t udp = 0;
    std::uint64_t can = 0;
    std::uint64_t fragments = 0;  // IPv4 fragments: not put together
    std::uint64_t ipv6 = 0;
    std::uint64_t other_protocols = 0;  // ARP, TCP, CAN XL, ...
    std::uint64_t unknown_link = 0;     // of an interface whose link type is not taken apart
    std::uint64_t cut_short = 0;        // captured with a limit that cut into the payload
    std::uint64_t malformed = 0;        // headers that contradict themselves
    std::uint64_t oversized = 0;        // larger than the reader's window

    friend bool operator==(const CaptureCounters&, const CaptureCounters&) = default;
};

}  // namespace skyig::protocol::recording
