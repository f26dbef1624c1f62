// How the fields that a layout describes are taken from a packet's bytes and put there. Shared by what reads
// raw and what reads and checks at once; no one else needs it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "protocol/cigi/layout.h"

namespace skyig::protocol::cigi::detail {

/// 3.3 sends 100 octets of text at most, the NUL included; 4.0 what its 16-bit size can say.
inline constexpr std::size_t kMaxText33 = 99;
inline constexpr std::size_t kMaxTextPacket33 = 104;
inline constexpr std::size_t kMaxPacket40 = 65528;

constexpr unsigned mask_of(const Place& place) noexcept {
    return (1U << place.bits) - 1U;
}

inline std::string_view text_at(std::span<const std::byte> bytes, std::size_t offset) noexcept {
    const auto* begin = reinterpret_cast<const char*>(bytes.data()) + offset;
    const char* end = begin + (bytes.size() - offset);
    return {begin, static_cast<std::size_t>(std::find(begin, end, '\0') - begin)};
}

inline std::string_view fitting(std::string_view text, Version version, std::size_t offset) noexcept {
    return text.substr(0, version == Version::k33 ? kMaxText33 : kMaxPacket40 - offset - 1);
}

/// A text need be neither padded nor ended by a NUL: senders exist that do neither.
template <class P>
bool fits(std::size_t bytes, Version version) noexcept {
    const std::size_t size = shape_of<P>(version).size;
    if constexpr (has_text<P>()) {
        return bytes >= size && bytes <= (version == Version::k33 ? kMaxTextPacket33 : kMaxPacket40);
    } else {
        return size > 0 && bytes == size;
    }
}

template <class P, Version V, ByteOrder Order, std::size_t I>
[[gnu::always_inline]] inline void read_field(std::span<const std::byte> bytes, P& packet) noexcept {
    constexpr const auto& kField = std::get<I>(Layout<P>::kFields);
    constexpr Place kPlace = kField.place(V);
    if constexpr (kPlace.present) {
        using Value = typename std::decay_t<decltype(kField)>::Value;
        Value& value = packet.*(kField.member);
        if constexpr (std::is_same_v<Value, std::string_view>) {
            value = text_at(bytes, kPlace.byte);
        } else if constexpr (kPlace.bits > 0) {
            const unsigned byte = std::to_integer<unsigned>(bytes[kPlace.byte]);
            value = static_cast<Value>((byte >> kPlace.bit) & mask_of(kPlace));
        } else {
            value = static_cast<Value>(load<typename Raw<Value>::Type>(bytes.data() + kPlace.byte, Order));
        }
    }
}

template <class P, Version V, ByteOrder Order, std::size_t I>
void write_field(const P& packet, std::byte* bytes) noexcept {
    constexpr const auto& kField = std::get<I>(Layout<P>::kFields);
    constexpr Place kPlace = kField.place(V);
    if constexpr (kPlace.present) {
        using Value = typename std::decay_t<decltype(kField)>::Value;
        const Value& value = packet.*(kField.member);
        if constexpr (std::is_same_v<Value, std::string_view>) {
            const std::string_view text = fitting(value, V, kPlace.byte);
            std::transform(text.begin(), text.end(), bytes + kPlace.byte,
                           [](char c) { return static_cast<std::byte>(c); });
        } else if constexpr (kPlace.bits > 0) {
            const unsigned part = (static_cast<unsigned>(value) & mask_of(kPlace)) << kPlace.bit;
            bytes[kPlace.byte] |= static_cast<std::byte>(part);
        } else {
            store(bytes + kPlace.byte, Order, static_cast<typename Raw<Value>::Type>(value));
        }
    }
}

template <class P, Version V, ByteOrder Order, std::size_t... I>
[[gnu::always_inline]] inline void read_fields(std::span<const std::byte> bytes, P& packet,
                                               std::index_sequence<I...> /*fields*/) noexcept {
    (read_field<P, V, Order, I>(bytes, packet), ...);
}

template <class P, Version V, ByteOrder Order, std::size_t... I>
void write_fields(const P& packet, std::byte* bytes, std::index_sequence<I...> /*fields*/) noexcept {
    (write_field<P, V, Order, I>(packet, bytes), ...);
}

/// Calls `use` with version and order as constants, so that every place and swap is settled when compiling.
template <class Use>
void with_constants(Version version, ByteOrder order, Use&& use) {
    constexpr std::integral_constant<Version, Version::k33> k33;
    constexpr std::integral_constant<Version, Version::k40> k40;
    constexpr std::integral_constant<ByteOrder, ByteOrder::kLittle> kLittle;
    constexpr std::integral_constant<ByteOrder, ByteOrder::kBig> kBig;
    if (version == Version::k33) {
        order == ByteOrder::kLittle ? use(k33, kLittle) : use(k33, kBig);
    } else {
        order == ByteOrder::kLittle ? use(k40, kLittle) : use(k40, kBig);
    }
}

}  // namespace skyig::protocol::cigi::detail
