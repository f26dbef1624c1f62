// How much of an area's weather there is at a point.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "render/weather.h"

namespace skyig::render {

/// Along the ground from the edge of the rounded rectangle, metres; negative inside.
/// \param point_m  east and north of the eye
[[nodiscard]] inline double area_distance_m(const WeatherArea& area, const glm::dvec2& point_m) noexcept {
    const glm::dvec2 from = point_m - area.centre_m;
    const double sine = std::sin(area.axis_rad), cosine = std::cos(area.axis_rad);
    const double beyond_x_m = std::abs(from.x * sine + from.y * cosine) - area.half_size_m.x;
    const double beyond_y_m = std::abs(from.x * cosine - from.y * sine) - area.half_size_m.y;
    return std::hypot(std::max(beyond_x_m, 0.0), std::max(beyond_y_m, 0.0)) +
           std::min(std::max(beyond_x_m, beyond_y_m), 0.0) - area.corner_radius_m;
}

/// 1 inside, falling linearly to 0 over the perimeter.
[[nodiscard]] inline double area_weight(const WeatherArea& area, const glm::dvec2& point_m) noexcept {
    const double outside_m = area_distance_m(area, point_m);
    if (outside_m <= 0.0) return 1.0;
    return outside_m < area.perimeter_m ? 1.0 - outside_m / area.perimeter_m : 0.0;
}

}  // namespace skyig::render
