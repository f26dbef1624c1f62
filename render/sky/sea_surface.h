// A wavy mirror: slopes of the sea, and what it reflects of light from above. Pure mathematics, no table of
// the air.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "render/scene.h"

namespace skyig::render::sky {

/// Refractive index of sea water in the middle of the visible.
inline constexpr double kSeaIndex = 1.34;

/// Fresnel's reflectance of unpolarised light at a level mirror of sea water. \param cosine  of the angle of
/// incidence, 0..1 (clamped)
[[nodiscard]] double fresnel_reflectance(double cosine) noexcept;

/// Mean products of the slopes towards east and north.
struct SlopeVariance {
    double east_east = 0.0015;
    double north_north = 0.0015;
    double east_north = 0.0;

    [[nodiscard]] double total() const noexcept { return east_east + north_north; }
};

/// Largest slope of a train of height H (trough to crest) and length L, a sine of small slope (Airy 1845): pi
/// H / L, H / L at most 0.142 (Michell 1893: then it breaks). 0 for what is no wave.
[[nodiscard]] double wave_slope(const Wave& wave) noexcept;

/// Wind: clean surface of Cox and Munk, J. Opt. Soc. Am. 44 (1954) 838: 0.00316 W along it, 0.003 + 0.00192 W
/// across, and half their sum each way below the wind where the lines cross (2.4 m/s); W in m/s at 12.5 m,
/// here 0..25 (measured to 14; what is not finite counts as 0). Waves: half the square of wave_slope() along
/// their way.
[[nodiscard]] SlopeVariance slope_variance(const Ground& ground, std::span<const Wave> waves) noexcept;

/// As surfaces are drawn: without wind the sea is smooth along it, but a slope of 1 deg always is left, each
/// way.
[[nodiscard]] SlopeVariance roughened(const SlopeVariance& variance) noexcept;

/// Slopes are Gaussian (Cox and Munk's skewness and peakedness are left out), hiding and shadowing are
/// Smith's (1967) as Ross, Dion and Potier, J. Opt. Soc. Am. A 22 (2005) 2442, use them for the sea. Skylight
/// that one facet turns down to another counts as coming from as high above the level. Of a source's light
/// that meets a second wave, what that one reflects goes up as from a dull surface, more of it onwards than
/// back.
///
/// Directions are unit vectors from the surface in the plane of view: x away from the eye, y to its right, z
/// up.
class SeaSurface {
  public:
    SeaSurface() noexcept : SeaSurface(SlopeVariance{}) {}
    /// Of slopes roughened(); 0.2 ms.
    explicit SeaSurface(const SlopeVariance& variance) noexcept;

    [[nodiscard]] const SlopeVariance& variance() const noexcept { return variance_; }

    /// The facets that mirror a small source into the eye.
    struct Mirror {
        double density = 0.0;      ///< of their slope, a unit of slope^2
        double per_density = 0.0;  ///< glitter_per_sr() over that
    };
    [[nodiscard]] Mirror mirror(double view_up, double view_azimuth_rad,
                                const glm::dvec3& source) const noexcept;

    /// Radiance towards the eye over irradiance on a plane facing the rays of a small source, 1/sr.
    /// \param view_up  sine of the elevation at which the surface sees the eye, 0..1 \param view_azimuth_rad
    /// clockwise from north, of x \param source  unit vector; a source below the level counts as on it
    [[nodiscard]] double glitter_per_sr(double view_up, double view_azimuth_rad,
                                        const glm::dvec3& source) const noexcept;

    /// Where the eye looks to by way of one facet, and what part of the light there this makes of the whole.
    struct Facet {
        glm::dvec3 reflected{0.0, 0.0, 1.0};
        double share = 0.0;
        /// Where it was before it was turned up, sine of the elevation.
        double mirrored_up = 1.0;
        /// Of its slope, away from the eye and to the right, in units of facet_slope().
        glm::dvec2 deviation{0.0};
    };
    static constexpr std::size_t kFacets = 24;
    using Facets = std::array<Facet, kFacets>;
    /// Quadrature over the facets that are seen from there, also from below the level; wind and waves taken
    /// as without direction. Shares sum to the mean reflectance.
    [[nodiscard]] Facets facets(double view_up) const noexcept;

    /// Root mean square of the facets' slope each way.
    [[nodiscard]] double facet_slope() const noexcept { return std::sqrt(0.5 * variance_.total()); }

    /// Of the surface as the eye sees it: 0.02 from above; at the horizon well below 1.
    [[nodiscard]] double mean_reflectance(double view_up) const noexcept;

  private:
    [[nodiscard]] double density(double view_azimuth_rad, const glm::dvec2& slope) const noexcept;
    [[nodiscard]] double per_density(double view_up, double view_azimuth_rad, const glm::dvec3& source,
                                     const glm::dvec2& slope) const noexcept;

    /// Of light from `source_up`, what leaves the sea by way of a second wave.
    [[nodiscard]] double sent_on(double source_up) const noexcept;

    static constexpr std::size_t kNodes = 33;  // over the root of view_up
    SlopeVariance variance_;
    double determinant_ = 0.0;
    [[nodiscard]] static double up_of(std::size_t node) noexcept;
    [[nodiscard]] static double at_root(const std::array<double, kNodes>& nodes, double up) noexcept;
    std::array<double, kNodes> reflectance_{};
    std::array<double, kNodes> sent_on_{};  // as reflectance_, of a source
};

}  // namespace skyig::render::sky
