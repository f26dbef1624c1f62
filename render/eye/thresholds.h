// The smallest difference of luminance that the eye sees, by cones and by rods: Ferwerda, Pattanaik, Shirley
// and Greenberg (1996), equations 1 and 2.
#pragma once

namespace skyig::render::eye {

/// \param log_l  log10 of the luminance that the eye is adapted to, cd/m2, any finite value
/// \return log10 of the threshold, cd/m2; never falls with log_l, the published pieces meet within 0.012
[[nodiscard]] double log_threshold_cones(double log_l) noexcept;
[[nodiscard]] double log_threshold_rods(double log_l) noexcept;

}  // namespace skyig::render::eye
