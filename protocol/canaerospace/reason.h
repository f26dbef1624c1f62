// What became of a frame, and why: one short word a fault, as counters, logs and `skyig decode` show it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skyig::protocol::canaerospace {

enum class Outcome : std::uint8_t {
    kAccept,
    kReject,     // meant for CANaerospace and wrong
    kIgnore,     // sound, or free of any rule, and nothing that is read here
    kDuplicate,  // the message code of the frame before
    kStale,      // overtaken: its message code is an older one
    kBusError    // no data: the controller's report of a fault
};

/// "accept", "reject", "ignore", "duplicate", "stale", "bus-error".
[[nodiscard]] std::string_view outcome_name(Outcome outcome) noexcept;

/// The first fault found in a frame; the order of the checks is that of this list within each outcome.
enum class Reason : std::uint8_t {
    kNone,
    // reject
    kIdentifier,    // 29 bit: the parameter (low 16 bits) is above 2031
    kRemote,        // a remote transmission request
    kShort,         // no room for the header of four bytes
    kReservedType,  // data type 32..99
    kUserType,      // data type 100..255 that nobody configured
    kLength,        // length other than 4 + size of the data type
    kType,          // a data type that this identifier may not have
    kAscii,         // a byte above 127 in ASCII text
    kNonfinite,     // a NaN or an infinity
    kScale,         // SHORT2 whose scale is not above 0
    kLayer,         // cloud layer (service code or commit) above 7
    kRange,         // outside the parameter's range
    kCalendar,      // no time of day, or no day of the calendar
    kLoneLow,       // DOUBLEL without the DOUBLEH that belongs before it
    kPair,          // DOUBLEL whose message or service code does not belong to the DOUBLEH before it
    kLateLow,       // DOUBLEL too long after its DOUBLEH
    // ignore
    kFd,          // CAN FD, which CANaerospace does not know
    kUnassigned,  // 2032..2047
    kUserRange,   // UDH, UDL, DSD: an identifier that is not in the map
    kUnknown,     // NOD: an identifier that is not in the map
    kService,     // node service 16..255: reserved or the user's own
    // duplicate and stale
    kDuplicate,
    kOlder,
    // bus-error: by the class of the error, the gravest first where a frame tells several
    kBusOff,
    kNoAcknowledge,
    kController,
    kProtocol,
    kTransceiver,
    kTransmitTimeout,
    kLostArbitration,
    kRestarted,
    kBusError,
    kEnd
};

inline constexpr std::size_t kReasons = static_cast<std::size_t>(Reason::kEnd);

/// "identifier", "remote", ...; "none" for kNone.
[[nodiscard]] std::string_view reason_name(Reason reason) noexcept;
/// One plain sentence: what was wrong and what would be right.
[[nodiscard]] std::string_view reason_text(Reason reason) noexcept;
[[nodiscard]] Outcome outcome_of(Reason reason) noexcept;
/// The reason word of an error frame, from the error classes in its identifier (SocketCAN numbers).
[[nodiscard]] Reason bus_error_reason(std::uint32_t classes) noexcept;

}  // namespace skyig::protocol::canaerospace
