// Model `windlight`: attenuation and additive scatter by parameters, made by hand rather than measured.
#pragma once

#include "render/shaders/shared.h"
#include "render/sky/models/surroundings.h"
#include "render/sky/sky_radiance.h"
#include "render/sky_settings.h"

namespace skyig::render::sky::models {

/// What the haze between makes of an object: colour * passed_rgb + added_xyz (in XYZ).
struct WindlightBetween {
    glm::vec3 passed_rgb{1.0F};
    glm::vec3 added_xyz{0.0F};
};

/// shaders/sky/windlight.glsl over black space, `unit_cd_m2` candelas a square metre for each unit of colour.
/// The density thins out with the air above the eye; below the horizon the ray meets `multi`'s lit ground.
/// Under a Sun lower than 10 deg all of it fades as `multi` lights the ground, so that a set of colours made
/// for the day serves the whole day. Limits: a look, not a measurement; never truer than its parameters.
class WindlightSky final : public SkyRadiance {
  public:
    /// \param tables  with all orders
    void begin(const WindlightSettings& settings, const AirTables& tables, double eye_height_m,
               double source_elevation_rad) noexcept;

    [[nodiscard]] glm::vec3 xyz_above(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] glm::vec3 xyz_below(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] double horizon_elevation_rad() const noexcept override {
        return at_.horizon_elevation_rad();
    }

    /// Of an object in that direction; the nearer of it and the dome's end counts. \param distance_m  >= 0
    [[nodiscard]] WindlightBetween between(float elevation_rad, float relative_azimuth_rad,
                                           float distance_m) const noexcept;

  private:
    Surroundings at_;
    shaders32::Windlight haze_{};
    float unit_cd_m2_ = 0.0F;
};

}  // namespace skyig::render::sky::models
