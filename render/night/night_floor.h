// The dark sky that is always there: airglow and unresolved starlight with zodiacal light, as two smooth
// terms.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render::night {

/// Airglow at the zenith, cd/m2: 145 S10 (solar minimum), 1 S10 = 8.34e-7 cd/m2.
inline constexpr double kAirglowZenith_cd_m2 = 1.21e-4;
/// Sky mean of integrated and diffuse starlight with the zodiacal light away from the ecliptic, cd/m2.
inline constexpr double kBeyondAir_cd_m2 = 0.95e-4;

/// Illuminance of level ground under the whole dark sky, lux.
inline constexpr double kDarkSky_lux = 8e-4;

/// XYZ, Y in cd/m2. Airglow follows van Rhijn's layer at 90 km and thins out for eyes above it. Both terms
/// pay extinction (0.17 mag per air mass at sea level, falling with 8 km), of which the air gives 60 % back
/// as scattered light of the whole sky; so does the air before the ground. \param ground_cd_m2  luminance of
/// the ground without air before it
[[nodiscard]] glm::vec3 night_floor_xyz(double elevation_rad, double horizon_elevation_rad,
                                        double eye_height_m, bool ground, double ground_cd_m2) noexcept;

}  // namespace skyig::render::night
