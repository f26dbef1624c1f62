// Model `preetham`: Preetham, Shirley and Smits, "A practical analytic model for daylight", SIGGRAPH 1999.
#pragma once

#include "render/shaders/shared.h"
#include "render/sky/models/perez_colour.h"
#include "render/sky/models/surroundings.h"
#include "render/sky/sky_radiance.h"
#include "render/sky_settings.h"

namespace skyig::render::sky::models {

/// The printed formulas for a Sun of 3 deg and more, turbidity 2..10 (turbidity_of() if the settings give
/// none). Beyond them: the formulas' Sun stays at 3 deg while the true one sinks (the bright spot goes with
/// it), and their light fades as `multi` lights the ground; it thins out with the air above the eye; below
/// the horizon lies `multi`'s lit ground in air of the horizon's colour. Limits: an eye low down, a clear
/// sky; as printed about twice as bright as the truth in clear air (`zenith_of_multi` mends that), from high
/// up without a bright limb.
class PreethamSky final : public SkyRadiance {
  public:
    /// \param tables  with all orders
    void begin(const PreethamSettings& settings, const AirTables& tables, double eye_height_m,
               double source_elevation_rad) noexcept;

    [[nodiscard]] glm::vec3 xyz_above(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] glm::vec3 xyz_below(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] double horizon_elevation_rad() const noexcept override {
        return at_.horizon_elevation_rad();
    }

  private:
    Surroundings at_;
    PerezColour colour_;
    shaders32::PerezSky sky_{};
    float scale_ = 0.0F;  // zenith luminance over what Perez's function says there
};

}  // namespace skyig::render::sky::models
