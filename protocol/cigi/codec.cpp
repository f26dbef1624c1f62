#include "protocol/cigi/codec.h"

#include <algorithm>
#include <array>
#include <limits>

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
constexpr std::size_t kMaxPacket40 = 65528;

constexpr std::size_t kNoPacket = std::numeric_limits<std::size_t>::max();

template <std::size_t First, std::size_t... I>
constexpr std::array<Shape, sizeof...(I)> shapes(Version version, std::index_sequence<I...> /*kinds*/) {
    return {shape_of<std::tuple_element_t<First + I, AllPackets>>(version)...};
}
using AllKinds = std::make_index_sequence<kPacketKinds>;
using HostKinds = std::make_index_sequence<kHostPacketKinds>;
using IgKinds = std::make_index_sequence<kPacketKinds - kHostPacketKinds>;

constexpr auto kHostShapes33 = shapes<0>(Version::k33, HostKinds{});
constexpr auto kHostShapes40 = shapes<0>(Version::k40, HostKinds{});
constexpr auto kIgShapes33 = shapes<kHostPacketKinds>(Version::k33, IgKinds{});
constexpr auto kIgShapes40 = shapes<kHostPacketKinds>(Version::k40, IgKinds{});

template <std::size_t... I>
constexpr bool all_sound(std::index_sequence<I...> /*kinds*/) {
    return ((layout_is_sound<std::tuple_element_t<I, AllPackets>>(Version::k33) &&
             layout_is_sound<std::tuple_element_t<I, AllPackets>>(Version::k40)) &&
            ...);
}
static_assert(all_sound(AllKinds{}), "a field lies outside its packet, unaligned, or over another one");

template <std::size_t N>
constexpr bool ids_differ(const std::array<Shape, N>& shapes) {
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = i + 1; j < N; ++j) {
            if (shapes[i].size > 0 && shapes[j].size > 0 && shapes[i].id == shapes[j].id) return false;
        }
    }
    return true;
}
static_assert(ids_differ(kHostShapes33) && ids_differ(kHostShapes40));
static_assert(ids_differ(kIgShapes33) && ids_differ(kIgShapes40));

template <std::size_t N>
std::size_t find_id(const std::array<Shape, N>& shapes, std::uint16_t id) noexcept {
    for (std::size_t i = 0; i < N; ++i) {
        if (shapes[i].id == id && shapes[i].size > 0) return i;
    }
    return kNoPacket;
}

/// What stands on the wire for a T: the type itself, an enumeration's underlying type.
template <class T, bool IsEnum = std::is_enum_v<T>>
struct Raw {
    using Type = T;
};
template <class T>
struct Raw<T, true> {
    using Type = std::underlying_type_t<T>;
};

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
    const std::size_t found = find_id(version == Version::k33 ? kHostShapes33 : kHostShapes40, id);
    if (found == kNoPacket) return std::nullopt;
    return found;
}

std::optional<std::size_t> ig_packet_kind(Version version, std::uint16_t id) noexcept {
    const std::size_t found = find_id(version == Version::k33 ? kIgShapes33 : kIgShapes40, id);
    if (found == kNoPacket) return std::nullopt;
    return kHostPacketKinds + found;
}

std::string_view packet_name(std::size_t kind) noexcept {
    static constexpr auto kNames = names(AllKinds{});
    return kind < kNames.size() ? kNames[kind] : std::string_view("unknown");
}

template <class P>
bool read_packet(std::span<const std::byte> bytes, Version version, ByteOrder order, P& packet) noexcept {
    const std::size_t size = shape_of<P>(version).size;
    if (size == 0 || bytes.size() < size || (bytes.size() != size && !has_text<P>())) return false;
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

// A type of AllPackets that is missing here shows as an undefined reference. The argument is a type, so no
// parentheses. NOLINTBEGIN(bugprone-macro-parentheses)
#define SKYIG_CIGI_PACKET(P)                                                                   \
    template bool read_packet<P>(std::span<const std::byte>, Version, ByteOrder, P&) noexcept; \
    template std::size_t packet_bytes<P>(const P&, Version) noexcept;                          \
    template void write_packet<P>(const P&, Version, ByteOrder, std::byte*) noexcept;
SKYIG_CIGI_PACKET(IgControl)
SKYIG_CIGI_PACKET(EntityControl)
SKYIG_CIGI_PACKET(EntityPosition)
SKYIG_CIGI_PACKET(ComponentControl)
SKYIG_CIGI_PACKET(ShortComponentControl)
SKYIG_CIGI_PACKET(CelestialSphereControl)
SKYIG_CIGI_PACKET(AtmosphereControl)
SKYIG_CIGI_PACKET(EnvRegionControl)
SKYIG_CIGI_PACKET(WeatherControl)
SKYIG_CIGI_PACKET(ViewControl)
SKYIG_CIGI_PACKET(ViewDefinition)
SKYIG_CIGI_PACKET(HatHotRequest)
SKYIG_CIGI_PACKET(PositionRequest)
SKYIG_CIGI_PACKET(EnvConditionsRequest)
SKYIG_CIGI_PACKET(StartOfFrame)
SKYIG_CIGI_PACKET(HatHotResponse)
SKYIG_CIGI_PACKET(HatHotExtendedResponse)
SKYIG_CIGI_PACKET(PositionResponse)
SKYIG_CIGI_PACKET(WeatherConditionsResponse)
SKYIG_CIGI_PACKET(AerosolResponse)
SKYIG_CIGI_PACKET(MaritimeSurfaceResponse)
SKYIG_CIGI_PACKET(TerrestrialSurfaceResponse)
SKYIG_CIGI_PACKET(EventNotification)
SKYIG_CIGI_PACKET(IgMessage)
#undef SKYIG_CIGI_PACKET
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace skyig::protocol::cigi
