// CIGI datagrams taken apart for people and programs: every field of every packet by the name it has in the
// interface tables, and every packet that an image generator would refuse, with the reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/cigi/catalogue.h"

namespace skyig::clients {

/// Flags and enumerations are integers, a binary32 is the double of the same value; nothing: the field holds
/// a NaN or an infinity and does not count.
using CigiValue = std::variant<std::monostate, std::int64_t, double, std::string>;

struct CigiField {
    std::string_view name;
    CigiValue value;
};

/// A packet as an image generator takes it in: angles wrapped, percentages clamped.
struct CigiPacket {
    std::string_view name;
    std::uint32_t offset = 0;
    std::vector<CigiField> fields;
    bool clamped = false;
};

/// A known packet that is not taken in. `reason` is a counter's name; `field` is empty if the fault is no
/// field's.
struct CigiIgnored {
    std::string_view name;
    std::uint32_t offset = 0;
    std::string_view reason;
    std::string_view field;
};

/// A packet that is passed over by its size, being none of those that skyig reads.
struct CigiSkipped {
    std::string_view name;
    std::uint16_t id = 0;
    std::uint32_t offset = 0;
    std::size_t bytes = 0;
};

enum class CigiOutcome : std::uint8_t {
    kAccept,   // framing sound to the end
    kPartial,  // framing lost part-way; the packets before are kept
    kDrop      // no CIGI message of this direction
};

struct CigiDatagram {
    std::size_t bytes = 0;
    protocol::cigi::Sender sender = protocol::cigi::Sender::kHost;
    CigiOutcome outcome = CigiOutcome::kDrop;
    std::string_view version;     ///< "3.3" or "4.0"; empty when dropped
    std::string_view byte_order;  ///< "little" or "big"; empty when dropped
    /// Counter's name of what dropped it or lost its framing, and where; empty when accepted.
    std::string_view reason;
    std::uint32_t fault_offset = 0;
    /// Dropped, but a sound message of the other direction.
    bool other_direction = false;
    std::vector<CigiPacket> packets;
    std::vector<CigiIgnored> ignored;
    std::vector<CigiSkipped> skipped;
};

[[nodiscard]] CigiDatagram decode_cigi(std::span<const std::byte> bytes, protocol::cigi::Sender sender);

/// Some lines: the message first, then a paragraph for each packet, in the order of the datagram.
[[nodiscard]] std::string to_text(const CigiDatagram& datagram);
/// One line without its end:
/// {"cigi":"3.3","byte_order":"big","outcome":"accept","reason":null,"packets":[{"packet":..,"offset":..,
/// "fields":{..}}],"skipped_unknown":N,"ignored":[{"packet":..,"reason":..}]}
[[nodiscard]] std::string to_json(const CigiDatagram& datagram);

struct HexError {
    std::size_t column = 0;  ///< from 1
    std::string text;        ///< what stands there and what would be right
};

/// Two digits a byte, with white space anywhere. Nothing, and `error` set, for other text.
[[nodiscard]] std::optional<std::vector<std::byte>> parse_hex(std::string_view text, HexError& error);

}  // namespace skyig::clients
