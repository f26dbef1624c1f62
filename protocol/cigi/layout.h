// The vocabulary in which packets are described. Layout<P> (layout_host.h, layout_ig.h) says once, for both
// versions, where each field of P lies, how wide it is and what it may hold; reading, writing, checking and
// listing by name all follow from it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "protocol/cigi/codec.h"
#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

/// Where a field lies in the packet, counted from the packet's first byte; bits from the least significant
/// one.
struct Place {
    std::uint16_t byte = 0;
    std::uint8_t bit = 0;
    std::uint8_t bits = 0;  // 0: a whole scalar (or, for a text, all that follows)
    bool present = false;
};

[[nodiscard]] constexpr Place at(std::uint16_t byte) noexcept {
    return {byte, 0, 0, true};
}
[[nodiscard]] constexpr Place bits(std::uint16_t byte, std::uint8_t first, std::uint8_t count) noexcept {
    return {byte, first, count, true};
}
inline constexpr Place kAbsent{};

/// Id and size of a packet in one version; size 0: the version has no such packet. A packet with a text has
/// its text's offset as size.
struct Shape {
    std::uint16_t id = 0;
    std::uint16_t size = 0;
};

/// What stands on the wire for a T: the type itself, an enumeration's underlying type.
template <class T, bool IsEnum = std::is_enum_v<T>>
struct Raw {
    using Type = T;
};
template <class T>
struct Raw<T, true> {
    using Type = std::underlying_type_t<T>;
};

struct Range {
    enum class Kind : std::uint8_t {
        kAny,
        kClosed,    // low..high, both included
        kHalfOpen,  // low..high without high
        kPositive,  // above 0
        kPercent,   // clamped to 0..100
        kHalfTurn,  // degrees, wrapped to -180..180
        kFullTurn,  // degrees, wrapped to 0..360
        kTwoTurns   // degrees, wrapped to -360..360
    };
    Kind kind = Kind::kAny;
    double low = 0.0;
    double high = 0.0;
};

template <class P, class T>
struct Field {
    using Value = T;

    std::string_view name;
    T P::*member;
    Place v33;
    Place v40;
    Range range{};
    /// Null, or says whether the field's value counts in this packet.
    bool (*counts)(const P&) = nullptr;

    [[nodiscard]] constexpr Place place(Version version) const noexcept {
        return version == Version::k33 ? v33 : v40;
    }

    [[nodiscard]] constexpr Field between(double low, double high) const noexcept {
        return with({Range::Kind::kClosed, low, high});
    }
    [[nodiscard]] constexpr Field below(double high) const noexcept {
        return with({Range::Kind::kHalfOpen, 0.0, high});
    }
    [[nodiscard]] constexpr Field up_to(double high) const noexcept { return between(0.0, high); }
    [[nodiscard]] constexpr Field not_negative() const noexcept { return up_to(3.5e38); }
    [[nodiscard]] constexpr Field positive() const noexcept { return with({Range::Kind::kPositive}); }
    [[nodiscard]] constexpr Field percent() const noexcept { return with({Range::Kind::kPercent}); }
    [[nodiscard]] constexpr Field latitude() const noexcept { return between(-90.0, 90.0); }
    [[nodiscard]] constexpr Field half_turn() const noexcept { return with({Range::Kind::kHalfTurn}); }
    [[nodiscard]] constexpr Field full_turn() const noexcept { return with({Range::Kind::kFullTurn}); }
    [[nodiscard]] constexpr Field two_turns() const noexcept { return with({Range::Kind::kTwoTurns}); }
    [[nodiscard]] constexpr Field when(bool (*condition)(const P&)) const noexcept {
        Field field = *this;
        field.counts = condition;
        return field;
    }
    template <bool P::*Flag>
    [[nodiscard]] constexpr Field enabled_by() const noexcept {
        return when([](const P& packet) { return packet.*Flag; });
    }

  private:
    [[nodiscard]] constexpr Field with(Range new_range) const noexcept {
        Field field = *this;
        field.range = new_range;
        return field;
    }
};

template <class P, class T>
[[nodiscard]] constexpr Field<P, T> field(std::string_view name, T P::*member, Place v33,
                                          Place v40) noexcept {
    return {name, member, v33, v40};
}

/// For P of AllPackets: kName, k33, k40 (Shape) and kFields (tuple of Field).
template <class P>
struct Layout;

template <class P>
[[nodiscard]] constexpr Shape shape_of(Version version) noexcept {
    return version == Version::k33 ? Layout<P>::k33 : Layout<P>::k40;
}

template <class P>
inline constexpr std::size_t kFieldCount = std::tuple_size_v<decltype(Layout<P>::kFields)>;

/// Calls `use(field)` for each Field of P in the order of the interface tables.
template <class P, class Use>
constexpr void for_each_field(Use&& use) {
    std::apply([&use](const auto&... each) { (use(each), ...); }, Layout<P>::kFields);
}

/// True if P ends in a text, so that its size varies.
template <class P>
[[nodiscard]] constexpr bool has_text() noexcept {
    bool found = false;
    for_each_field<P>([&found](const auto& each) {
        found = found || std::is_same_v<typename std::decay_t<decltype(each)>::Value, std::string_view>;
    });
    return found;
}

/// Calls `use(name, value)` for each field that P has in `version`; `value` is the integer, floating or
/// string_view value as on the wire (flags and enumerations as integers).
template <class P, class Use>
void visit_fields(const P& packet, Version version, Use&& use) {
    for_each_field<P>([&](const auto& each) {
        if (!each.place(version).present) return;
        using Value = typename std::decay_t<decltype(each)>::Value;
        const Value& value = packet.*(each.member);
        if constexpr (std::is_enum_v<Value>) {
            use(each.name, static_cast<std::underlying_type_t<Value>>(value));
        } else if constexpr (std::is_same_v<Value, bool>) {
            use(each.name, static_cast<std::uint8_t>(value ? 1 : 0));
        } else {
            use(each.name, value);
        }
    });
}

namespace detail {

/// Claims the bits of one field; false if they lie outside the packet, are unaligned, or are taken already.
template <class Value>
[[nodiscard]] constexpr bool claim(const Place& place, std::size_t header, std::size_t size,
                                   std::array<std::uint8_t, 256>& taken) noexcept {
    if (!place.present) return true;
    if constexpr (std::is_same_v<Value, std::string_view>) {
        return place.byte == size;
    } else {
        const std::size_t width = place.bits > 0 ? 1 : sizeof(Value);
        if (place.byte < header || place.byte + width > size || place.byte % width != 0) return false;
        if (place.bits == 0 && std::is_same_v<Value, bool>) return false;
        if (place.bits > 0 &&
            (place.bit + place.bits > 8 || !(std::is_integral_v<Value> || std::is_enum_v<Value>))) {
            return false;
        }
        const unsigned mask = place.bits > 0 ? ((1U << place.bits) - 1U) << place.bit : 0xFFU;
        for (std::size_t i = place.byte; i < place.byte + width; ++i) {
            if ((taken[i] & mask) != 0) return false;
            taken[i] = static_cast<std::uint8_t>(taken[i] | mask);
        }
        return true;
    }
}

}  // namespace detail

/// Every field inside the packet and behind its header, aligned to its own size, none over another; the
/// packet's size a multiple of 8.
template <class P>
[[nodiscard]] constexpr bool layout_is_sound(Version version) noexcept {
    const Shape shape = shape_of<P>(version);
    std::array<std::uint8_t, 256> taken{};
    bool sound = shape.size <= taken.size() && (has_text<P>() || shape.size % 8 == 0);
    for_each_field<P>([&](const auto& each) {
        using Value = typename std::decay_t<decltype(each)>::Value;
        const Place place = each.place(version);
        sound = sound && (shape.size > 0 || !place.present) &&
                detail::claim<Value>(place, header_bytes(version), shape.size, taken);
    });
    return sound;
}

}  // namespace skyig::protocol::cigi
