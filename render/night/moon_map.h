// What the Moon's face looks like: its albedo, relative to the mean of the full disc. Made when the program
// is built from places, sizes and albedos of the maria and the bright craters (generator/moon_features.h);
// nothing below 1 deg of the Moon (30 km) is meant to be true.
#pragma once

#include <cstdint>
#include <numbers>
#include <span>

namespace skyig::render::night {

inline constexpr int kMoonMapSize = 512;
/// Of a texel of relative albedo 1.
inline constexpr double kMoonMapOne = 128.0;

/// kMoonMapSize^2 texels, rows from the south, columns from the west, at the places of
/// shaders::moon_map_place().
[[nodiscard]] std::span<const std::uint8_t> moon_map() noexcept;

inline constexpr int kMoonPhaseCount = 33;
/// From -165 to 165 deg.
[[nodiscard]] constexpr double moon_phase_longitude_rad(int index) noexcept {
    return (index * 330.0 / (kMoonPhaseCount - 1) - 165.0) * std::numbers::pi / 180.0;
}

/// Mean of the map over the disc as it is lit, 1 at full Moon: weights by Lommel-Seeliger, no libration.
/// \param sun_longitude_rad  of the Sun east of the disc's middle, -pi..pi: > 0 while the Moon waxes; held
/// beyond 165 deg
[[nodiscard]] double moon_map_mean(double sun_longitude_rad) noexcept;

}  // namespace skyig::render::night
