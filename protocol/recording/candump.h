// Lines of a candump log (`candump -L`, `candump -l`), read and written byte for byte:
//   (1718994600.002500) can0 138#01020010C1640000      11-bit identifier, three hex digits
//   (1718994600.065000) can0 00010130#01020012         29-bit identifier, eight hex digits
//   (1718994600.070000) can0 123#R4                    remote frame that asks for four bytes
//   (1718994600.075000) can0 123##5001122              CAN FD: one digit of flags, then the data
//   (1718994600.080000) can0 20000004#0001000000000000 error frame
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/can_frame.h"
#include "protocol/result.h"

namespace skyig::protocol::recording {

/// The longest interface name of Linux.
inline constexpr std::size_t kInterfaceChars = 15;

struct CandumpLine {
    /// received_ns is the line's time stamp; `bus` is 0.
    CanFrame frame;
    /// 1..15 characters; when read, a part of the line.
    std::string_view interface;
    /// Digits of the time stamp behind the point, 1..9.
    std::uint8_t fraction_digits = 6;
    /// Blanks before the interface; candump aligns the names of several.
    std::uint8_t blanks = 1;
    /// 9..15: the length code that stood on the wire of a frame of 8 bytes (`_9` .. `_F`); else 0.
    std::uint8_t raw_length_code = 0;
    /// 'R' or 'T', received or sent (`candump -x`); 0: not told.
    char direction = 0;
};

enum class CandumpFault : std::uint8_t {
    kTime,
    kInterface,
    kIdentifier,
    kStandardRange,
    kExtendedRange,
    kSeparator,
    kFlags,
    kDigits,
    kClassicLength,
    kFdLength,
    kRemoteLength,
    kLengthCode,
    kTrailing,
    kEnd
};

struct CandumpError {
    /// From 1.
    std::uint32_t column = 1;
    CandumpFault fault = CandumpFault::kTime;
};

/// What would be right in its place.
[[nodiscard]] std::string_view candump_fault_text(CandumpFault fault) noexcept;
/// "FILE:LINE:COLUMN: what would be right"
[[nodiscard]] std::string describe(const CandumpError& error, std::string_view file, std::uint64_t line);

/// Nothing but blanks, or a comment that begins with '#'.
[[nodiscard]] bool is_blank_or_comment(std::string_view line) noexcept;

/// \param line  without its end of line; a carriage return at its end is passed over
[[nodiscard]] Result<CandumpLine, CandumpError> parse_candump(std::string_view line) noexcept;

/// The longest line: time stamp, names, 64 bytes of data.
inline constexpr std::size_t kCandumpLineChars = 512;

/// Writes `line` without end of line. \return the characters written, a part of `buffer`.
/// Digits behind `fraction_digits` are cut off. Lengths beyond the frame's kind are written as its largest.
[[nodiscard]] std::string_view write_candump(const CandumpLine& line,
                                             std::span<char, kCandumpLineChars> buffer) noexcept;

}  // namespace skyig::protocol::recording
