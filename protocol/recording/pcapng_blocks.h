// The numbers of the pcapng format (IETF draft-ietf-opsawg-pcapng) that reader and writer share. A block is
// its type, its length, a body in units of four bytes and its length again.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skyig::protocol::recording::pcapng {

namespace block {
inline constexpr std::uint32_t kSection = 0x0A0D0D0A;  // the same in both byte orders
inline constexpr std::uint32_t kInterface = 1;
inline constexpr std::uint32_t kObsoletePacket = 2;
inline constexpr std::uint32_t kSimplePacket = 3;
inline constexpr std::uint32_t kEnhancedPacket = 6;
}  // namespace block

namespace option {
inline constexpr std::uint16_t kEnd = 0;
inline constexpr std::uint16_t kComment = 1;
inline constexpr std::uint16_t kInterfaceName = 2;
inline constexpr std::uint16_t kSectionProgram = 4;
inline constexpr std::uint16_t kStampResolution = 9;
inline constexpr std::uint16_t kStampOffset = 14;
}  // namespace option

inline constexpr std::uint32_t kByteOrderMagic = 0x1A2B3C4D;

// Where the body of a block begins, and where the options of each kind that is read.
inline constexpr std::size_t kBodyOffset = 8;
inline constexpr std::size_t kSectionOptions = 24;
inline constexpr std::size_t kInterfaceOptions = 16;
inline constexpr std::size_t kSimplePacketData = 12;
inline constexpr std::size_t kPacketData = 28;
inline constexpr std::size_t kTrailerBytes = 4;
inline constexpr std::size_t kOptionHeaderBytes = 4;
inline constexpr std::size_t kMinBlockBytes = 12;

/// `bytes` with the padding to the next multiple of four.
[[nodiscard]] constexpr std::size_t padded(std::size_t bytes) noexcept {
    return (bytes + 3) & ~std::size_t{3};
}

}  // namespace skyig::protocol::recording::pcapng
