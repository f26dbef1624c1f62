// The light of the stars that are not drawn one by one, and of the dust that it meets: by galactic
// coordinates, as smooth as it is measured.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render::night {

/// Galactic axes (x to the centre, z to the north pole) from GCRS; IAU 1958 as Hipparcos gives it.
[[nodiscard]] const glm::dmat3& galactic_from_gcrs() noexcept;

/// Half width of the belt about the galactic equator that starlight() parts, radians.
inline constexpr double kBelt_rad = 0.5235987755982988;

/// Starlight is drawn in two parts: what goes on evenly through the belt, and what the Milky Way adds to it
/// there, which is 0 at the belt's edges and outside. S10.
struct Starlight {
    double even = 0.0;
    double belt = 0.0;
};

/// Stars fainter than V 6.5 with the diffuse galactic light (which is in the measurements that the fit
/// follows: nothing is to be added for it). An analytic fit of twenty numbers to the maps of Pioneer 10 and
/// 11 (Toller 1981; Leinert et al. 1998, table 35), 440 nm, made for this program: 16 % rms in the logarithm,
/// weighted by solid angle. \param longitude_rad, latitude_rad  galactic
[[nodiscard]] Starlight starlight_s10(double longitude_rad, double latitude_rad) noexcept;

/// Of it the part that interstellar dust has scattered: 20 to 30 % (Leinert et al. 1998, section 11).
inline constexpr double kGalacticLightShare = 0.22;

/// Geometric mean outside the belt.
[[nodiscard]] double typical_starlight_s10() noexcept;

}  // namespace skyig::render::night
