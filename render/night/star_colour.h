// From a star's catalogue magnitudes to light: colour of its colour index, illuminance of its V magnitude.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render::night {

/// Range of B-V that the colours are made for; what lies outside is taken as the nearer end.
inline constexpr double kMinBv = -0.4;
inline constexpr double kMaxBv = 2.0;

/// Temperature in kelvin of the black body with that B-V (Ballesteros 2012), 3169..21707 K.
[[nodiscard]] double temperature_from_bv_k(double bv) noexcept;

/// CIE 1931 xy of a black body: cubic of Kim et al. 2002, within 0.003 of the integral over Planck's law.
/// \param temperature_k  clamped to the fit's 1667..25000 K
[[nodiscard]] glm::dvec2 planckian_xy(double temperature_k) noexcept;

/// Linear Rec.709 (D65 white) of that chromaticity with luminance 1: desaturated at constant luminance where
/// a component would be negative, so every component is >= 0. `xy` within the spectral locus, y > 0.
[[nodiscard]] glm::dvec3 linear_rec709_of_xy(const glm::dvec2& xy) noexcept;

/// Linear Rec.709 colour of a star, luminance 1. Not a number counts as the Sun's 0.65.
[[nodiscard]] glm::dvec3 star_colour_of_bv(double bv) noexcept;

/// Illuminance in lux above the atmosphere of a star of V magnitude `vmag`: 2.54e-6 lux at magnitude 0.
[[nodiscard]] double star_illuminance_lux(double vmag) noexcept;

}  // namespace skyig::render::night
