// The Earth's shadow where the Moon is: eclipses of the Moon.
#pragma once

#include <glm/glm.hpp>

namespace skyig::server::ephemeris {

/// Lengths in radii of the Moon (1737.4 km).
struct EarthShadow {
    /// From the Moon's centre to the shadow's axis, perpendicular to it; axes as the arguments. With the Moon
    /// on the sunny side of the Earth, where there is no shadow: as far off as the Earth.
    glm::dvec3 axis{221.0, 0.0, 0.0};
    /// How far from the axis umbra and penumbra end in the plane of the Moon's centre.
    double umbra_radius = 2.6;
    double penumbra_radius = 4.7;
    /// Part of the sunlight that is left to the Moon's disc, mean over the disc, 0..1; no limb darkening.
    double sunlit = 1.0;
};

/// Cones about a spherical Earth of 1.01 equatorial radii: Danjon's enlargement, 1/85 for the air less 1/594
/// for the flattening (as in the Five Millennium Canon of Lunar Eclipses, Espenak & Meeus 2009).
/// \param moon_km  Earth to Moon when the light reached the Moon, the Earth where that light passed it
/// \param sun_km   Earth to Sun then
/// Error: contacts within 4 s of the published ones, sunlit 0.001 (tests). Within the
/// penumbra it costs a hundred times what it costs elsewhere.
[[nodiscard]] EarthShadow earth_shadow(const glm::dvec3& moon_km, const glm::dvec3& sun_km) noexcept;

}  // namespace skyig::server::ephemeris
