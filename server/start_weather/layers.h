// Layers of the settings as the Weather Control that a host would send for them, and the layer ids that this
// image generator gives a meaning.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/packets.h"

namespace skyig::server {

/// CIGI's layer ids, and of those left to the image generator: 10 drizzle, 11 smoke, 12 haze. 13..255, and 10
/// to 12 with a cloud type, are clouds.
enum class LayerId : std::uint8_t {
    kGroundFog = 0,
    kCloud1 = 1,
    kCloud3 = 3,
    kRain = 4,
    kSnow = 5,
    kSleet = 6,
    kHail = 7,
    kSand = 8,
    kDust = 9,
    kDrizzle = 10,
    kSmoke = 11,
    kHaze = 12,
    kFirstOwnCloud = 14,
};

/// Wind at a height over that at 10 m: (z / 10 m)^0.14 up to 300 m, the same above; 1 below 10 m.
[[nodiscard]] double wind_gain(double height_agl_m) noexcept;

/// Global layers, each enabled. A cloud of an id that is there already, or another layer of a type that is,
/// takes its place. Without a wind of its own, or of 0 m/s, a layer tells none.
[[nodiscard]] std::vector<protocol::cigi::WeatherControl> weather_controls(
    std::span<const config::WeatherLayer> layers, const config::Air& air, double elevation_m);

}  // namespace skyig::server
