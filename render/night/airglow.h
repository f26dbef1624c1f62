// The faint light of the upper air itself: a thin layer at 90 km.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render::night {

inline constexpr double kAirglowHeight_m = 90e3;

/// Straight up from below the layer, S10: 145 at solar minimum, twice that at maximum (Leinert et al. 1998).
/// \param solar_activity  0..1
[[nodiscard]] double airglow_zenith_s10(double solar_activity) noexcept;

/// How much longer a ray is within the layer than one straight up through it: before and behind its nearest
/// point to the ground, which is where air dims it.
struct AirglowPath {
    double near = 0.0;  ///< nothing but thin air before it
    double far = 0.0;   ///< behind all air of the ray
};

/// From below the layer van Rhijn's law, (1 - (r / (R + h))^2 cos^2 elevation)^(-1/2), eased off at a layer's
/// thickness of 8 km; from above, once for each crossing. \param ground  the ray ends there
/// \param elevation_rad  straight; \param height_m  of the eye
[[nodiscard]] AirglowPath airglow_path(double elevation_rad, double height_m, bool ground) noexcept;

/// Linear Rec.709 of luminance 1: lines at 557.7, 589 and 630 nm (250, 60 and 120 R) over 0.35 R/A of
/// continuum.
[[nodiscard]] glm::dvec3 airglow_colour() noexcept;

}  // namespace skyig::render::night
