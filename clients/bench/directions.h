// Directions to ask light for, and the floor of asking: what the families of light share.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>

#include "clients/bench/timing.h"

namespace skyig::clients::bench {

inline constexpr std::size_t kDirections = 1024;

/// Elevation and azimuth in radians, even over the sphere, in no order.
[[nodiscard]] std::shared_ptr<const std::array<glm::vec2, kDirections>> directions();

/// A sky of one colour, looked up in these directions.
[[nodiscard]] Work one_colour_floor();

}  // namespace skyig::clients::bench
