// What the renderer asks of any model of the day sky: light by direction, for one eye and one light source.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render::sky {

/// Values are XYZ with Y in cd/m2 for a source with the Sun's spectrum and irradiance at 1 AU: the caller
/// scales them for distance, obscuration or the Moon. Neither the disc nor the night sky is in them. Every
/// look-up is finite and >= 0; none allocates.
///
/// Angles are radians, without refraction: elevations above the horizontal at the eye, -pi/2..pi/2 (clamped),
/// azimuths from that of the source, any finite value. An angle that is not finite gets black.
class SkyRadiance {
  public:
    virtual ~SkyRadiance() = default;

    /// From one side of the geometric horizon only: a direction beyond it gets the value at the edge.
    [[nodiscard]] virtual glm::vec3 xyz_above(float elevation_rad,
                                              float relative_azimuth_rad) const noexcept = 0;
    [[nodiscard]] virtual glm::vec3 xyz_below(float elevation_rad,
                                              float relative_azimuth_rad) const noexcept = 0;

    /// Elevation of the geometric horizon at the eye: minus its dip, <= 0.
    [[nodiscard]] virtual double horizon_elevation_rad() const noexcept = 0;

    [[nodiscard]] glm::vec3 xyz(float elevation_rad, float relative_azimuth_rad) const noexcept {
        return elevation_rad >= static_cast<float>(horizon_elevation_rad())
                   ? xyz_above(elevation_rad, relative_azimuth_rad)
                   : xyz_below(elevation_rad, relative_azimuth_rad);
    }

  protected:
    SkyRadiance() = default;
    SkyRadiance(const SkyRadiance&) = default;
    SkyRadiance& operator=(const SkyRadiance&) = default;
    SkyRadiance(SkyRadiance&&) = default;
    SkyRadiance& operator=(SkyRadiance&&) = default;
};

}  // namespace skyig::render::sky
