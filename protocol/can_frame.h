// One frame of a CAN bus as a value, free of any operating system's headers: what a socket, a recording or a
// test hands to the protocols above.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace skyig::protocol {

inline constexpr std::uint32_t kMaxStandardId = 0x7FFU;
inline constexpr std::uint32_t kMaxExtendedId = 0x1FFF'FFFFU;
inline constexpr std::size_t kClassicBytes = 8;
inline constexpr std::size_t kFdBytes = 64;

/// The flags of a CAN FD frame from what a source tells: of those that are known the two that the bus
/// carries, and the format's own, which old kernels, old writers and `##` of candump logs leave out.
constexpr std::uint8_t fd_flags_from(unsigned told) noexcept {
    constexpr unsigned kOfTheBus = 0x03;
    constexpr unsigned kFormat = 0x04;
    return static_cast<std::uint8_t>((told & kOfTheBus) | kFormat);
}

/// Exactly one of the flags error, remote and fd may stand; none of them: a classic data frame.
struct CanFrame {
    /// When it was received: nanoseconds since 1970-01-01 UTC, or since the recording's own start.
    std::int64_t received_ns = 0;
    /// 11 or 29 bits without any flag; of an error frame the bits of its error classes.
    std::uint32_t id = 0;
    /// The bytes of `data` that count; of a remote frame the length that it asks for. 0..8, with `fd` 0..64.
    std::uint8_t length = 0;
    /// Which of the program's buses it came from.
    std::uint8_t bus = 0;
    bool extended = false;
    bool remote = false;
    bool error = false;
    bool fd = false;
    /// CAN FD only, see fd_flags_from(): bit 0 bit-rate switch, bit 1 error state indicator, bit 2 FD format.
    std::uint8_t fd_flags = 0;
    std::array<std::uint8_t, kFdBytes> data{};

    [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept {
        const std::size_t most = fd ? kFdBytes : kClassicBytes;
        return std::span(data).first(length < most ? length : most);
    }
    friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

}  // namespace skyig::protocol
