// The stars a naked eye can see: Yale Bright Star Catalogue, 5th revised edition (Hoffleit & Warren 1991),
// compiled in.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace skyig::render::night {

struct CatalogueStar {
    /// Unit vector at epoch J2000.0, GCRS axes (FK5 of the catalogue, 0.02 arcsec from them). Float adds 0.01
    /// arcsec at most.
    glm::vec3 direction_gcrs;
    /// Radians a Julian year, tangent to the sphere at `direction_gcrs`. See direction_at().
    glm::vec3 proper_motion_rad_yr;
    /// Johnson V, -1.46 .. 7.96. Some doubles carry their combined light in both components.
    float vmag;
    /// Johnson B-V; where the catalogue has none (310 stars) the median of the spectral class, 0.6 without
    /// class (2).
    float bv;
    /// Harvard Revised number, 1..9110, ascending with gaps.
    std::uint16_t hr;
};

inline constexpr std::size_t kCatalogueStarCount = 9096;

/// All stars in order of HR number. Constant data, nothing happens at start-up. Positions are good to 0.65
/// arcsec (median against Hipparcos), 99 % to 4.4 arcsec.
[[nodiscard]] std::span<const CatalogueStar> star_catalogue() noexcept;

/// Unit vector after `years_since_j2000` Julian years of proper motion.
[[nodiscard]] glm::dvec3 direction_at(const CatalogueStar& star, double years_since_j2000) noexcept;

/// The star with that number, or nothing: 14 numbers are not stars.
[[nodiscard]] const CatalogueStar* find_star(int hr) noexcept;

}  // namespace skyig::render::night
