// From the bytes of a captured packet to the UDP datagram or CAN frame inside it.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/byte_order.h"
#include "protocol/recording/capture.h"

namespace skyig::protocol::recording {

enum class Contents : std::uint8_t {
    kUdp,
    kCan,
    kFragment,
    kIpv6,
    kOtherProtocol,
    kUnknownLink,
    kCutShort,
    kMalformed,
};

/// Sets kind and, of a datagram, from, to and payload; of a CAN frame, `can` (without time and bus).
/// Checksums are not looked at: a sending machine leaves them to its network card. \param whole       the
/// bytes are all that was on the wire: what then lacks is malformed, not cut short \param file_order  in
/// which cooked captures hold CAN identifiers
[[nodiscard]] Contents take_apart(std::uint32_t link_type, std::span<const std::byte> bytes, bool whole,
                                  ByteOrder file_order, CapturedPacket& packet) noexcept;

}  // namespace skyig::protocol::recording
