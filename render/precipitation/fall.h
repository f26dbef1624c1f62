// How large what falls is, how fast it falls, and how it is seen to come.
#pragma once

#include <glm/glm.hpp>

#include "render/weather.h"

namespace skyig::render::precipitation {

/// L of N(D) = N0 exp(-L D), 1/mm: rain by Marshall and Palmer 1948, drizzle by Joss, Thams and Waldvogel
/// 1968. \param rate_mm_h  > 0
[[nodiscard]] double rain_slope_per_mm(double rate_mm_h) noexcept;
[[nodiscard]] double drizzle_slope_per_mm(double rate_mm_h) noexcept;
/// Half of the water falls in larger drops: 3.67 / L (Atlas 1953).
[[nodiscard]] double median_drop_mm(double slope_per_mm) noexcept;

/// Diameter of the hailstones that are drawn.
inline constexpr double kHail_mm = 10.0;

/// Atlas, Srivastava and Sekhon 1973: 9.65 - 10.3 exp(-0.6 D), at the ground; 0 for the smallest.
[[nodiscard]] double drop_fall_speed_m_s(double diameter_mm) noexcept;
/// 9 sqrt(D / cm), at the ground.
[[nodiscard]] double hail_fall_speed_m_s(double diameter_mm) noexcept;

/// Thin air lets things fall faster: (density at the ground / density)^0.4 (Foote and du Toit 1969), in the
/// International Standard Atmosphere. 1 at height 0, no lower than that of -500 m, no higher than of 20 km.
[[nodiscard]] double aloft_factor(double height_m) noexcept;

/// Of the drops, flakes or stones that are drawn. \param rate_mm_h  of liquid water, > 0
[[nodiscard]] double fall_speed_m_s(Precipitation::Kind kind, double rate_mm_h, double height_m) noexcept;

/// What falls moves so before the eye, east, north, up: wind and fall less the eye's own velocity.
[[nodiscard]] glm::dvec3 relative_wind_m_s(const Weather& weather, double fall_speed_m_s) noexcept;

}  // namespace skyig::render::precipitation
