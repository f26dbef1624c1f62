// The faintest point of light that a practised eye sees.
#pragma once

namespace skyig::render::eye {

/// Illuminance at the eye, lux, of a point at the threshold before a uniform background (Knoll, Tousey and
/// Hulburt 1946 in the form of Schaefer 1990): C (1 + sqrt(K B))^2 with one pair of constants for rods and
/// one for cones. Published as two branches with a step of 0.08 mag at 4.8e-3 cd/m2; they cross close by, so
/// the smaller is continuous and right on either side. \param background_cd_m2  less than 1e-9 counts as 1e-9
[[nodiscard]] double threshold_lux(double background_cd_m2) noexcept;

}  // namespace skyig::render::eye
