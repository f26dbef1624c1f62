// How bright the Moon is: the light it sends and the luminance of its face, outside the air.
#pragma once

#include <glm/glm.hpp>

#include "render/scene.h"

namespace skyig::render::night {

/// Longitude of the Sun east of the middle of the disc, -pi..pi: > 0 while the Moon waxes.
[[nodiscard]] double sun_longitude_rad(const Moon& moon) noexcept;

/// Illuminance of a surface facing the Moon, lux, out of the Earth's shadow, the Sun 1 AU away. V = -12.73 +
/// 0.026 |a| + 4e-9 a^4 (Allen), a the phase angle in degrees, at 384400 km, 2.54e-6 lux at V = 0; with an
/// opposition surge of 28 % that falls by e in 1.9 deg, and the waxing Moon brighter than the waning one by
/// up to 14 % at the quarters (both after Kieffer and Stone 2005). Beyond 150 deg, where the law ends, the
/// light follows the Lommel-Seeliger function.
[[nodiscard]] double moon_illuminance_lux(double phase_angle_rad, double distance_km,
                                          double sun_longitude_rad = 0.0) noexcept;

/// The same of the scene's Moon.
[[nodiscard]] double moon_illuminance_lux(const Moon& moon, double sun_distance_au) noexcept;

/// Factor of shaders::lommel_seeliger() times the map's relative albedo, cd/m2: the sum of the disc is
/// moon_illuminance_lux() at every phase.
[[nodiscard]] double moon_face_cd_m2(const Moon& moon, double sun_distance_au = 1.0) noexcept;

/// Mean luminance of the whole disc, its dark part in the light of the Earth, cd/m2: what an eye that looks
/// at it adapts to.
[[nodiscard]] double moon_mean_cd_m2(const Moon& moon, double sun_distance_au = 1.0) noexcept;

/// Luminance of the dark side in the light of the Earth, cd/m2, of ground of the Moon's mean albedo.
[[nodiscard]] double earthshine_cd_m2(double phase_angle_rad) noexcept;

/// Factors on linear red, green, blue of sunlight that make earthlight on the Moon of equal luminance: 0.15
/// mag of B-V bluer than moonlight (the Earth's air scatters blue back).
[[nodiscard]] glm::dvec3 earthshine_tint_rgb() noexcept;

/// Factors on linear red, green, blue of sunlight that make moonlight of equal luminance: B-V of 0.9 against
/// 0.65.
[[nodiscard]] glm::dvec3 moon_tint_rgb() noexcept;

/// The same as factors on X, Y and Z of sunlight.
[[nodiscard]] glm::dvec3 moon_tint_xyz() noexcept;

}  // namespace skyig::render::night
