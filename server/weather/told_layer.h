// What one Weather Control means to the picture (table in docs/weather.md).
#pragma once

#include <optional>

#include "config/weather.h"
#include "protocol/cigi/packets.h"
#include "server/weather/layer_state.h"

namespace skyig::server::weather {

struct Meaning {
    /// Of the base state: what the air dims by itself, in a layer's own visibility already.
    double air_extinction_per_m = 0.0;
    /// Left over of a black target at the visibility that is told.
    double contrast = 0.05;
    /// Above it, heights tell which genus a cloud is that has none.
    double elevation_m = 0.0;
    /// How wet snow is.
    double temperature_c = 15.0;
};

/// Nothing for a layer without thickness or coverage, and for what this image generator does not know.
/// Area, cover and distance are the caller's to fill. Weather of an entity: give its height as `carrier_m`;
/// its transition band is the radius of partial penetration round it.
[[nodiscard]] std::optional<ToldLayer> told_layer(const protocol::cigi::WeatherControl& control,
                                                  const Meaning& meaning,
                                                  std::optional<double> carrier_m = {}) noexcept;

/// Of a layer's type that is a cloud.
[[nodiscard]] render::CloudGenus genus_of(config::LayerType type) noexcept;

/// Towards east and north, of a wind that blows from there.
[[nodiscard]] glm::dvec2 wind_towards_m_s(double speed_m_s, double from_deg) noexcept;

}  // namespace skyig::server::weather
