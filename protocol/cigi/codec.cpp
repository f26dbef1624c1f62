#include "protocol/cigi/codec.h"

#include <algorithm>
#include <array>

#include "protocol/cigi/counters.h"
#include "protocol/cigi/layout.h"
#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"

namespace skyig::protocol::cigi {
namespace {

constexpr std::uint16_t kMajor33 = 3;
constexpr std::uint16_t kMajor40 = 4;
constexpr std::uint8_t kMinor33 = 3;
constexpr std::uint8_t kMinor40 = 0;

/// 3.3 sends 100 octets of text at most, the NUL included; 4.0 what its 16-bit size can say.
constexpr std::size_t kMaxText33 = 99;
constexpr std::size_t kMaxTextPacket33 = 104;
constexpr std::size_t kMaxPacket40 = 65528;

template <std::size_t First, std::size_t... I>
constexpr std::array<Shape, sizeof...(I)> shapes(Version version, std::index_sequence<I...> /*kinds*/) {
    return {shape_of<std::tuple_element_t<First + I, AllPackets>>(version)...};
}
using AllKinds = std::make_index_sequence<kPacketKinds>;
using HostKinds = std::make_index_sequence<kHostPacketKinds>;
using IgKinds = std::make_index_sequence<kPacketKinds - kHostPacketKinds>;

template <std::size_t... I>
constexpr bool all_sound(std::index_sequence<I...> /*kinds*/) {
    return ((layout_is_sound<std::tuple_element_t<I, AllPackets>>(Version::k33) &&
             layout_is_sound<std::tuple_element_t<I, AllPackets>>(Version::k40)) &&
            ...);
}
static_assert(all_sound(AllKinds{}), "a field lies outside its packet, unaligned, or over another one");

/// From id to the packet's place in `shapes` in one look; no two ids of one direction and version fold alike.
template <std::size_t N>
class KindOfId {
  public:
    explicit constexpr KindOfId(const std::array<Shape, N>& shapes) noexcept : shapes_(shapes) {
        for (std::size_t i = 0; i < N; ++i) {
            if (shapes[i].size == 0) continue;
            std::uint8_t& slot = slots_[folded(shapes[i].id)];
            distinct_ = distinct_ && slot == 0;
            slot = static_cast<std::uint8_t>(i + 1);
        }
    }
    [[nodiscard]] constexpr bool distinct() const noexcept { return distinct_; }
    [[nodiscard]] std::optional<std::size_t> find(std::uint16_t id) const noexcept {
        const std::size_t slot = slots_[folded(id)];
        if (slot == 0 || shapes_[slot - 1].id != id) return std::nullopt;
        return slot - 1;
    }

  private:
    [[nodiscard]] static constexpr std::size_t folded(std::uint16_t id) noexcept {
        return (id ^ (id >> 8U)) & 0xFFU;
    }

    std::array<Shape, N> shapes_;
    std::array<std::uint8_t, 256> slots_{};  // 0: none
    bool distinct_ = true;
};

constexpr KindOfId kHostKinds33(shapes<0>(Version::k33, HostKinds{}));
constexpr KindOfId kHostKinds40(shapes<0>(Version::k40, HostKinds{}));
constexpr KindOfId kIgKinds33(shapes<kHostPacketKinds>(Version::k33, IgKinds{}));
constexpr KindOfId kIgKinds40(shapes<kHostPacketKinds>(Version::k40, IgKinds{}));
static_assert(kHostKinds33.distinct() && kHostKinds40.distinct() && kIgKinds33.distinct() &&
              kIgKinds40.distinct());

constexpr unsigned mask_of(const Place& place) noexcept {
    return (1U << place.bits) - 1U;
}

std::string_view text_at(std::span<const std::byte> bytes, std::size_t offset) noexcept {
    const auto* begin = reinterpret_cast<const char*>(bytes.data()) + offset;
    const char* end = begin + (bytes.size() - offset);
    return {begin, static_cast<std::size_t>(std::find(begin, end, '\0') - begin)};
}

std::string_view fitting(std::string_view text, Version version, std::size_t offset) noexcept {
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
void read_field(std::span<const std::byte> bytes, P& packet) noexcept {
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
void read_fields(std::span<const std::byte> bytes, P& packet, std::index_sequence<I...> /*fields*/) noexcept {
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

/// IG Control and Start of Frame say the version themselves: a struct that leaves it open gets the writer's.
template <class P>
P with_version(P packet, Version version) noexcept {
    if constexpr (requires { packet.major_version; }) {
        const auto major = static_cast<std::uint8_t>(version == Version::k33 ? kMajor33 : kMajor40);
        if (packet.major_version != major) {
            packet.major_version = major;
            packet.minor_version = version == Version::k33 ? kMinor33 : kMinor40;
        }
    }
    return packet;
}

void write_header(const PacketHeader& header, Version version, ByteOrder order, std::byte* bytes) noexcept {
    if (version == Version::k33) {
        bytes[0] = static_cast<std::byte>(header.id);
        bytes[1] = static_cast<std::byte>(header.size);
    } else {
        store(bytes, order, header.size);
        store(bytes + 2, order, header.id);
    }
}

template <std::size_t... I>
constexpr std::array<std::string_view, sizeof...(I)> names(std::index_sequence<I...> /*kinds*/) {
    return {Layout<std::tuple_element_t<I, AllPackets>>::kName...};
}

}  // namespace

PacketHeader read_header(const std::byte* bytes, Version version, ByteOrder order) noexcept {
    if (version == Version::k33)
        return {std::to_integer<std::uint16_t>(bytes[0]), std::to_integer<std::uint16_t>(bytes[1])};
    return {load<std::uint16_t>(bytes + 2, order), load<std::uint16_t>(bytes, order)};
}

std::optional<std::size_t> host_packet_kind(Version version, std::uint16_t id) noexcept {
    return version == Version::k33 ? kHostKinds33.find(id) : kHostKinds40.find(id);
}

std::optional<std::size_t> ig_packet_kind(Version version, std::uint16_t id) noexcept {
    const std::optional<std::size_t> found =
        version == Version::k33 ? kIgKinds33.find(id) : kIgKinds40.find(id);
    if (!found) return std::nullopt;
    return kHostPacketKinds + *found;
}

std::string_view packet_name(std::size_t kind) noexcept {
    static constexpr auto kNames = names(AllKinds{});
    return kind < kNames.size() ? kNames[kind] : std::string_view("unknown");
}

template <class P>
bool read_packet(std::span<const std::byte> bytes, Version version, ByteOrder order, P& packet) noexcept {
    if (!fits<P>(bytes.size(), version)) return false;
    with_constants(version, order, [&](auto v, auto o) {
        read_fields<P, decltype(v)::value, decltype(o)::value>(bytes, packet,
                                                               std::make_index_sequence<kFieldCount<P>>{});
    });
    return true;
}

template <class P>
std::size_t packet_bytes(const P& packet, Version version) noexcept {
    const std::size_t size = shape_of<P>(version).size;
    if constexpr (has_text<P>()) {
        const std::size_t with_nul = size + fitting(packet.text, version, size).size() + 1;
        return (with_nul + 7) & ~std::size_t{7};
    } else {
        static_cast<void>(packet);
        return size;
    }
}

template <class P>
void write_packet(const P& packet, Version version, ByteOrder order, std::byte* bytes) noexcept {
    const std::size_t size = packet_bytes(packet, version);
    std::fill_n(bytes, size, std::byte{0});
    if (size == 0) return;
    const PacketHeader header{shape_of<P>(version).id, static_cast<std::uint16_t>(size)};
    write_header(header, version, order, bytes);
    const P stamped = with_version(packet, version);
    with_constants(version, order, [&](auto v, auto o) {
        write_fields<P, decltype(v)::value, decltype(o)::value>(stamped, bytes,
                                                                std::make_index_sequence<kFieldCount<P>>{});
    });
}

// The argument is a type, so no parentheses. NOLINTBEGIN(bugprone-macro-parentheses)
#define SKYIG_CIGI_INSTANTIATE(P)                                                              \
    template bool read_packet<P>(std::span<const std::byte>, Version, ByteOrder, P&) noexcept; \
    template std::size_t packet_bytes<P>(const P&, Version) noexcept;                          \
    template void write_packet<P>(const P&, Version, ByteOrder, std::byte*) noexcept;
SKYIG_CIGI_HOST_PACKETS(SKYIG_CIGI_INSTANTIATE)
SKYIG_CIGI_IG_PACKETS(SKYIG_CIGI_INSTANTIATE)
#undef SKYIG_CIGI_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace skyig::protocol::cigi
