// What of told weather can be drawn. The standard lets a host say any number; a cloud of a million
// kilometres would hold frames up for seconds, and a wind of 1e38 m/s leads out of all numbers.
#pragma once

#include "protocol/cigi/packets.h"

namespace skyig::server::world {

/// Of air along the ground and up, m/s: twice what storms and jets have.
inline constexpr double kMostWind_m_s = 200.0;
inline constexpr double kMostUpdraught_m_s = 100.0;
/// Bases of layers, m above the ellipsoid; how thick they and the bands outside may be, m.
inline constexpr double kLowestLayer_m = -2'000.0;
inline constexpr double kHighestLayer_m = 60'000.0;
inline constexpr double kThickestLayer_m = 20'000.0;
/// Round an entity, and sides of regions, m: half round the Earth.
inline constexpr double kLargestArea_m = 20'000'000.0;

/// Brings what lies outside to the nearest that can be drawn; infinite counts as large, no number as the
/// least. \return whether anything lay outside
bool limit(protocol::cigi::WeatherControl& layer) noexcept;
bool limit(protocol::cigi::EnvRegionControl& region) noexcept;

}  // namespace skyig::server::world
