// One layer of weather between the world that tells it and the scene that shows it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "protocol/cigi/packets.h"
#include "render/weather.h"
#include "server/weather/eye_plane.h"

namespace skyig::server::weather {

enum class Family : std::uint8_t { kCloud, kObscurant, kFalling };

/// What of a layer changes gradually; which members count depends on the family.
struct LayerState {
    double base_m = 0.0;
    double thickness_m = 0.0;
    double bottom_band_m = 0.0;
    double top_band_m = 0.0;
    /// 0..1
    double coverage = 0.0;
    double extinction_per_m = 0.0;
    double rate_mm_h = 0.0;
    double severity = 0.0;
    double bottom_scud = 0.0;
    double top_scud = 0.0;
    double flashes_per_min = 0.0;

    friend bool operator==(const LayerState&, const LayerState&) = default;
};

/// Which layer it is. Another genus or kind is another layer.
struct LayerKey {
    /// Scope, region or entity, layer id.
    std::uint32_t place = 0;
    Family family = Family::kCloud;
    /// render::CloudGenus, Obscurant::Kind or Precipitation::Kind.
    std::uint8_t kind = 0;

    friend bool operator==(const LayerKey&, const LayerKey&) = default;
};

[[nodiscard]] inline protocol::cigi::WeatherScope scope_of(const LayerKey& key) noexcept {
    return static_cast<protocol::cigi::WeatherScope>(key.place >> 24U);
}

/// A layer as it is told.
struct ToldLayer {
    LayerKey key;
    LayerState state;
    /// Everywhere, if none.
    std::optional<GroundArea> area;
    /// What other regions leave of it at the eye, 0..1.
    double uncovered = 1.0;
    /// Towards east and north, if the layer has one of its own.
    std::optional<glm::dvec2> wind_m_s;
    /// From the eye to the area's outer edge, along the ground; 0 where the eye is in it.
    double distance_m = 0.0;
};

/// Part `t` of the way, member by member; coverage and extinction on the scales of render/weather_ramp.h.
[[nodiscard]] LayerState mix(const LayerState& from, const LayerState& to, double t) noexcept;

/// The layer as it begins and ends: clouds without coverage, the others without extinction and rate.
[[nodiscard]] LayerState nothing_of(Family family, const LayerState& state) noexcept;

}  // namespace skyig::server::weather
