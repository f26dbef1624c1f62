// One packet between bytes and struct. Both directions follow from the one description in layout_host.h and
// layout_ig.h; values are taken raw (no range is checked: see validate.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "protocol/cigi/packet_list.h"
#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

inline constexpr std::size_t kHeaderBytes33 = 2;
inline constexpr std::size_t kHeaderBytes40 = 4;

struct PacketHeader {
    std::uint16_t id = 0;
    std::uint16_t size = 0;
};

/// Bytes of a packet header: id and size (3.3), size and id (4.0).
[[nodiscard]] constexpr std::size_t header_bytes(Version version) noexcept {
    return version == Version::k33 ? kHeaderBytes33 : kHeaderBytes40;
}

/// `bytes` holds header_bytes(version) at least.
[[nodiscard]] inline PacketHeader read_header(const std::byte* bytes, Version version,
                                              ByteOrder order) noexcept {
    if (version == Version::k33)
        return {std::to_integer<std::uint16_t>(bytes[0]), std::to_integer<std::uint16_t>(bytes[1])};
    return {load<std::uint16_t>(bytes + 2, order), load<std::uint16_t>(bytes, order)};
}

/// Kind of a packet that a host may send (index in AllPackets); kPacketKinds for an id that this library does
/// not read.
[[nodiscard]] std::size_t host_packet_kind(Version version, std::uint16_t id) noexcept;
/// The same for a packet that an image generator may send.
[[nodiscard]] std::size_t ig_packet_kind(Version version, std::uint16_t id) noexcept;

/// Reads one packet; `bytes` is the whole packet with its header. False, and nothing read, if its length is
/// not the packet's in this version. Instantiated for every type of AllPackets.
template <class P>
[[nodiscard]] bool read_packet(std::span<const std::byte> bytes, Version version, ByteOrder order,
                               P& packet) noexcept;

/// Bytes that this packet takes; 0 if the version has no such packet.
template <class P>
[[nodiscard]] std::size_t packet_bytes(const P& packet, Version version) noexcept;

/// Writes header and fields into packet_bytes(packet, version) bytes; reserved bytes become 0.
template <class P>
void write_packet(const P& packet, Version version, ByteOrder order, std::byte* bytes) noexcept;

}  // namespace skyig::protocol::cigi
