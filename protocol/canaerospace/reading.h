// One CAN frame read as CANaerospace, without any memory of the frames before: identifier, header, data type,
// and the value that the identifier map gives it. What needs memory (message codes, halves of doubles,
// redundancy) is in receiver.h.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "protocol/can_frame.h"
#include "protocol/canaerospace/identifier_map.h"
#include "protocol/canaerospace/reason.h"

namespace skyig::protocol::canaerospace {

enum class Range : std::uint8_t {
    kEmergency,    // EED 0..127
    kServiceHigh,  // NSH 128..199
    kUserHigh,     // UDH 200..299
    kNormal,       // NOD 300..1799
    kUserLow,      // UDL 1800..1899
    kDebug,        // DSD 1900..1999
    kServiceLow,   // NSL 2000..2031
    kUnassigned    // 2032..2047
};

[[nodiscard]] Range range_of(std::uint32_t id) noexcept;

/// The codes of node services 0..15, "IDS" ...; empty above.
[[nodiscard]] std::string_view service_name(std::uint8_t service_code) noexcept;

struct Message {
    Range range = Range::kUnassigned;
    /// The parameter's identifier, without redundancy channel.
    std::uint16_t id = 0;
    /// Redundancy channel, 0..8191; 0 for 11-bit identifiers.
    std::uint16_t channel = 0;
    bool extended = false;
    std::uint8_t dlc = 0;
    /// False: the frame is too short for one, is no data frame, or has no rules; the next four are then 0.
    bool has_header = false;
    /// The transmitter; of a node service the addressed node, 0 = all.
    std::uint8_t node = 0;
    std::uint8_t type_code = 0;
    std::uint8_t service_code = 0;
    std::uint8_t message_code = 0;
    /// Of the identifier, or null. Belongs to the IdentifierIndex that was asked.
    const MapEntry* entry = nullptr;

    [[nodiscard]] bool is(DataType type) const noexcept {
        return has_header && type_code == static_cast<std::uint8_t>(type);
    }
    [[nodiscard]] bool is_service() const noexcept {
        return range == Range::kServiceHigh || range == Range::kServiceLow;
    }
    /// Of a node service: the answer to one (odd identifiers).
    [[nodiscard]] bool is_reply() const noexcept { return is_service() && id % 2 == 1; }
};

struct Value {
    enum class Kind : std::uint8_t {
        kNone,     // no value (NODATA), or none yet (a half of a double)
        kReal,     // `number`
        kInteger,  // `number`, a whole one
        kList,     // `count` whole numbers in `items`
        kText      // `count` ASCII characters in `items`
    };
    Kind kind = Kind::kNone;
    std::uint8_t count = 0;
    /// In the entry's unit (see MapEntry::unit_of). Time of day: its seconds; date: days since 1970-01-01.
    double number = 0.0;
    /// Time of day: h, min, s and the fourth byte; date: day, month 1..12, year.
    std::array<std::int64_t, 4> items{};
};

struct Reading {
    /// kNone: accepted. Else the first fault; `value` is then kNone.
    Reason reason = Reason::kNone;
    Message message;
    Value value;
    /// DOUBLEH, DOUBLEL: the half.
    std::uint32_t word = 0;
};

/// Reads any frame, whatever it holds. A half of a double is accepted without a value.
[[nodiscard]] Reading read_frame(const CanFrame& frame, const IdentifierIndex& index) noexcept;

/// The value of both halves of a double under `entry`; kNonfinite or kRange where there is none.
[[nodiscard]] Reason read_double(const MapEntry& entry, std::uint32_t high, std::uint32_t low,
                                 Value& value) noexcept;

}  // namespace skyig::protocol::canaerospace
