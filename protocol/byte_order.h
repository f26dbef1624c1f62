// How one scalar is taken from bytes and put into them, in either byte order. Nothing here needs alignment:
// all access goes through memcpy. The caller sees to it that the bytes are there.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace skyig::protocol {

enum class ByteOrder : std::uint8_t { kLittle, kBig };

inline constexpr ByteOrder kNativeOrder =
    std::endian::native == std::endian::little ? ByteOrder::kLittle : ByteOrder::kBig;

namespace detail {

template <std::size_t Bytes>
struct Unsigned;
template <>
struct Unsigned<1> {
    using Type = std::uint8_t;
};
template <>
struct Unsigned<2> {
    using Type = std::uint16_t;
};
template <>
struct Unsigned<4> {
    using Type = std::uint32_t;
};
template <>
struct Unsigned<8> {
    using Type = std::uint64_t;
};

[[nodiscard]] constexpr std::uint8_t swapped(std::uint8_t word) noexcept {
    return word;
}
[[nodiscard]] constexpr std::uint16_t swapped(std::uint16_t word) noexcept {
    return __builtin_bswap16(word);
}
[[nodiscard]] constexpr std::uint32_t swapped(std::uint32_t word) noexcept {
    return __builtin_bswap32(word);
}
[[nodiscard]] constexpr std::uint64_t swapped(std::uint64_t word) noexcept {
    return __builtin_bswap64(word);
}

}  // namespace detail

/// Reads sizeof(T) bytes at `bytes`.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] T load(const std::byte* bytes, ByteOrder order) noexcept {
    typename detail::Unsigned<sizeof(T)>::Type word;
    std::memcpy(&word, bytes, sizeof(word));
    if (order != kNativeOrder) word = detail::swapped(word);
    return std::bit_cast<T>(word);
}

/// Writes sizeof(T) bytes at `bytes`.
template <class T>
requires std::is_arithmetic_v<T>
void store(std::byte* bytes, ByteOrder order, T value) noexcept {
    auto word = std::bit_cast<typename detail::Unsigned<sizeof(T)>::Type>(value);
    if (order != kNativeOrder) word = detail::swapped(word);
    std::memcpy(bytes, &word, sizeof(word));
}

}  // namespace skyig::protocol
