// Packets with a random value in every field, for tests that compare readers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"
#include "protocol/cigi/packet_list.h"

namespace skyig::protocol::cigi {

/// Calls `use.operator()<P>()` for every packet of AllPackets.
template <class Use>
void for_each_packet(Use&& use) {
    [&]<std::size_t... I>(std::index_sequence<I...> /*kinds*/) {
        (use.template operator()<std::tuple_element_t<I, AllPackets>>(), ...);
    }
    (std::make_index_sequence<kPacketKinds>{});
}

class RandomPackets {
  public:
    explicit RandomPackets(std::uint64_t seed) : random_(seed) {}

    /// A packet as it may stand on the wire in `version`: what its fields are wide enough for, enumerations
    /// within their range. Floats are multiples of 1/8 and doubles of 1/64 below 2^14, so that few decimal
    /// digits say them. IG Control and Start of Frame say the version. \param text  must outlive the packet
    template <class P>
    [[nodiscard]] P next(Version version, std::string& text) {
        P packet{};
        for_each_field<P>([&](const auto& field) {
            const Place place = field.place(version);
            if (place.present) packet.*(field.member) = value(field, place, text);
        });
        if constexpr (requires { packet.major_version; }) {
            packet.major_version = version == Version::k33 ? 3 : 4;
        }
        if constexpr (requires { packet.byte_swap; }) packet.byte_swap = kByteSwapMagic;
        return packet;
    }

    [[nodiscard]] std::uint64_t below(std::uint64_t end) {
        return std::uniform_int_distribution<std::uint64_t>(0, end - 1)(random_);
    }

  private:
    template <class P, class T>
    [[nodiscard]] T value(const Field<P, T>& field, const Place& place, std::string& text) {
        if constexpr (std::is_same_v<T, std::string_view>) {
            text.assign(below(100), ' ');
            std::generate(text.begin(), text.end(), [this] { return static_cast<char>('a' + below(26)); });
            return text;
        } else if constexpr (std::is_same_v<T, bool>) {
            return below(2) == 1;
        } else if constexpr (std::is_floating_point_v<T>) {
            constexpr std::int64_t kParts = std::is_same_v<T, float> ? 8 : 64;
            constexpr std::int64_t kLargest = 16384 * kParts;
            const auto number = static_cast<std::int64_t>(below(2 * kLargest)) - kLargest;
            return static_cast<T>(number) / static_cast<T>(kParts);
        } else {
            using Number = typename Raw<T>::Type;
            const unsigned bits = place.bits > 0 ? place.bits : 8 * sizeof(T);
            const bool bounded = std::is_enum_v<T> && field.range.kind == Range::Kind::kClosed;
            const auto last =
                bounded ? static_cast<std::uint64_t>(field.range.high) : (std::uint64_t{1} << bits) - 1;
            return static_cast<T>(static_cast<Number>(below(last + 1)));
        }
    }

    std::mt19937_64 random_;
};

}  // namespace skyig::protocol::cigi
