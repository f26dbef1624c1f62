// The lists of all packets that are read and written.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "protocol/cigi/packets.h"
#include "protocol/cigi/packets_sight.h"

namespace skyig::protocol::cigi {

// A packet's index in AllPackets is its kind in counters and names. Types,
// names and instantiations all follow from these two. X takes a type, so no parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define SKYIG_CIGI_HOST_PACKETS(X) \
    X(IgControl)                   \
    X(EntityControl)               \
    X(EntityPosition)              \
    X(ConformalClamped)            \
    X(RateControl)                 \
    X(AccelerationControl)         \
    X(ComponentControl)            \
    X(ShortComponentControl)       \
    X(CelestialSphereControl)      \
    X(AtmosphereControl)           \
    X(EnvRegionControl)            \
    X(WeatherControl)              \
    X(MaritimeSurfaceControl)      \
    X(WaveControl)                 \
    X(TerrestrialSurfaceControl)   \
    X(ViewControl)                 \
    X(ViewDefinition)              \
    X(EarthModelDefinition)        \
    X(HatHotRequest)               \
    X(LosSegmentRequest)           \
    X(LosVectorRequest)            \
    X(PositionRequest)             \
    X(EnvConditionsRequest)
#define SKYIG_CIGI_IG_PACKETS(X)  \
    X(StartOfFrame)               \
    X(HatHotResponse)             \
    X(HatHotExtendedResponse)     \
    X(LosResponse)                \
    X(LosExtendedResponse)        \
    X(PositionResponse)           \
    X(WeatherConditionsResponse)  \
    X(AerosolResponse)            \
    X(MaritimeSurfaceResponse)    \
    X(TerrestrialSurfaceResponse) \
    X(EventNotification)          \
    X(IgMessage)

#define SKYIG_CIGI_AS_TUPLE(P) std::declval<std::tuple<P>>(),
using HostPackets =
    decltype(std::tuple_cat(SKYIG_CIGI_HOST_PACKETS(SKYIG_CIGI_AS_TUPLE) std::declval<std::tuple<>>()));
using IgPackets =
    decltype(std::tuple_cat(SKYIG_CIGI_IG_PACKETS(SKYIG_CIGI_AS_TUPLE) std::declval<std::tuple<>>()));
#undef SKYIG_CIGI_AS_TUPLE
// NOLINTEND(bugprone-macro-parentheses)
using AllPackets = decltype(std::tuple_cat(std::declval<HostPackets>(), std::declval<IgPackets>()));

inline constexpr std::size_t kHostPacketKinds = std::tuple_size_v<HostPackets>;
inline constexpr std::size_t kPacketKinds = std::tuple_size_v<AllPackets>;

namespace detail {
template <class P, std::size_t I = 0>
[[nodiscard]] constexpr std::size_t kind_of() noexcept {
    static_assert(I < kPacketKinds, "not a CIGI packet of this library");
    if constexpr (std::is_same_v<P, std::tuple_element_t<I, AllPackets>>) {
        return I;
    } else {
        return kind_of<P, I + 1>();
    }
}
}  // namespace detail

template <class P>
inline constexpr std::size_t kPacketKind = detail::kind_of<P>();

}  // namespace skyig::protocol::cigi
