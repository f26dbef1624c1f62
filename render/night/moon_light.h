// How bright the Moon is: the light it sends and the luminance of its face, outside the air.
#pragma once

#include <glm/glm.hpp>

#include "render/scene.h"

namespace skyig::render::night {

/// Illuminance of a surface facing the Moon, lux. V = -12.73 + 0.026 |a| + 4e-9 a^4 (Allen), a the phase
/// angle in degrees, at 384400 km, with the opposition surge 1.35 - 0.05 a below 7 deg; 2.54e-6 lux at V = 0.
[[nodiscard]] double moon_illuminance_lux(double phase_angle_rad, double distance_km) noexcept;

/// Mean luminance of the whole disc, cd/m2, divided by the Lommel-Seeliger phase function: the factor of
/// shaders::lommel_seeliger(). Beyond 160 deg of phase, where the magnitude law ends, it is held.
[[nodiscard]] double moon_face_cd_m2(const Moon& moon) noexcept;

/// Luminance of the dark side in the light of the Earth, cd/m2.
[[nodiscard]] double earthshine_cd_m2(double phase_angle_rad) noexcept;

/// Factors on linear red, green, blue of sunlight that make moonlight of equal luminance: B-V of 0.9 against
/// 0.65.
[[nodiscard]] glm::dvec3 moon_tint_rgb() noexcept;

/// The same as factors on X, Y and Z of sunlight.
[[nodiscard]] glm::dvec3 moon_tint_xyz() noexcept;

}  // namespace skyig::render::night
