#include "protocol/cigi/codec.h"

#include <algorithm>
#include <array>

#include "protocol/cigi/counters.h"
#include "protocol/cigi/field_access.h"
#include "protocol/cigi/layout.h"
#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"

namespace skyig::protocol::cigi {
namespace {

constexpr std::uint16_t kMajor33 = 3;
constexpr std::uint16_t kMajor40 = 4;
constexpr std::uint8_t kMinor33 = 3;
constexpr std::uint8_t kMinor40 = 0;

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
class KindOfId {
  public:
    template <std::size_t N>
    explicit constexpr KindOfId(const std::array<Shape, N>& shapes) noexcept {
        for (std::size_t i = 0; i < N; ++i) {
            if (shapes[i].size == 0) continue;
            Slot& slot = slots_[folded(shapes[i].id)];
            distinct_ = distinct_ && slot.kind == kNone;
            slot = {shapes[i].id, static_cast<std::uint16_t>(i)};
        }
    }
    [[nodiscard]] constexpr bool distinct() const noexcept { return distinct_; }
    [[nodiscard]] std::size_t find(std::uint16_t id, std::size_t first) const noexcept {
        const Slot slot = slots_[folded(id)];
        return slot.id == id && slot.kind != kNone ? first + slot.kind : kPacketKinds;
    }

  private:
    static constexpr std::uint16_t kNone = 0xFFFF;
    struct Slot {
        std::uint16_t id = 0;
        std::uint16_t kind = kNone;
    };
    [[nodiscard]] static constexpr std::size_t folded(std::uint16_t id) noexcept {
        return (id ^ (id >> 8U)) & 0xFFU;
    }

    std::array<Slot, 256> slots_{};
    bool distinct_ = true;
};

constexpr KindOfId kHostKinds33(shapes<0>(Version::k33, HostKinds{}));
constexpr KindOfId kHostKinds40(shapes<0>(Version::k40, HostKinds{}));
constexpr KindOfId kIgKinds33(shapes<kHostPacketKinds>(Version::k33, IgKinds{}));
constexpr KindOfId kIgKinds40(shapes<kHostPacketKinds>(Version::k40, IgKinds{}));
static_assert(kHostKinds33.distinct() && kHostKinds40.distinct() && kIgKinds33.distinct() &&
              kIgKinds40.distinct());

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

std::size_t host_packet_kind(Version version, std::uint16_t id) noexcept {
    return (version == Version::k33 ? kHostKinds33 : kHostKinds40).find(id, 0);
}

std::size_t ig_packet_kind(Version version, std::uint16_t id) noexcept {
    return (version == Version::k33 ? kIgKinds33 : kIgKinds40).find(id, kHostPacketKinds);
}

std::string_view packet_name(std::size_t kind) noexcept {
    static constexpr auto kNames = names(AllKinds{});
    return kind < kNames.size() ? kNames[kind] : std::string_view("unknown");
}

template <class P>
bool read_packet(std::span<const std::byte> bytes, Version version, ByteOrder order, P& packet) noexcept {
    if (!detail::fits<P>(bytes.size(), version)) return false;
    detail::with_constants(version, order, [&](auto v, auto o) {
        detail::read_fields<P, decltype(v)::value, decltype(o)::value>(
            bytes, packet, std::make_index_sequence<kFieldCount<P>>{});
    });
    return true;
}

template <class P>
std::size_t packet_bytes(const P& packet, Version version) noexcept {
    const std::size_t size = shape_of<P>(version).size;
    if constexpr (has_text<P>()) {
        const std::size_t with_nul = size + detail::fitting(packet.text, version, size).size() + 1;
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
    detail::with_constants(version, order, [&](auto v, auto o) {
        detail::write_fields<P, decltype(v)::value, decltype(o)::value>(
            stamped, bytes, std::make_index_sequence<kFieldCount<P>>{});
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
