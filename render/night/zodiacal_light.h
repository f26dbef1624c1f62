// Sunlight scattered by dust between the planets.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render::night {

/// One tenth-magnitude star a square degree, cd/m2: 2.54e-6 lux at V = 0.
inline constexpr double kS10_cd_m2 = 8.34e-7;

/// Luminance outside the air in S10, annual mean from 1 AU. Leinert et al. 1998 (A&AS 127, 1), table 16, its
/// logarithm interpolated bilinearly; nearer than 15 deg to the Sun, where the table ends, 9000 (15 / e)^2.3
/// with e >= 2.5 deg (F-corona). \param longitude_rad  ecliptic, from the Sun's; \param latitude_rad ecliptic
[[nodiscard]] double zodiacal_s10(double longitude_rad, double latitude_rad) noexcept;

/// The same of a direction. \param direction_gcrs, sun_gcrs  unit vectors
[[nodiscard]] double zodiacal_s10(const glm::dvec3& direction_gcrs, const glm::dvec3& sun_gcrs) noexcept;

/// Its geometric mean away from the ecliptic (by more than 20 deg) in the half of the sky opposite to the
/// Sun: that of a dark zenith.
[[nodiscard]] double typical_zodiacal_s10() noexcept;

}  // namespace skyig::render::night
