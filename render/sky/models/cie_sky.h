// Model `cie`: the standard skies of ISO 15469:2004 (CIE S 011).
#pragma once

#include <optional>

#include "render/shaders/shared.h"
#include "render/sky/models/perez_colour.h"
#include "render/sky/models/surroundings.h"
#include "render/sky/sky_radiance.h"
#include "render/sky_settings.h"

namespace skyig::render::sky::models {

/// Coefficients of type 1..15, the nearest of them for other numbers.
[[nodiscard]] shaders64::CieSky cie_coefficients(int type) noexcept;

/// Relative luminance by the standard's formula, scaled to a zenith luminance: that of `multi`, or a measured
/// one. The standard says nothing of colour: it is the zenith's of `multi`, across the sky by Preetham's x
/// and y ratios. Limits: an eye on the ground by day, clear to overcast; ground and twilight are taken over
/// from `multi` through the zenith, a measured luminance fades below a Sun of 0 deg as that does. From high
/// up there is no bright limb.
class CieSky final : public SkyRadiance {
  public:
    /// \param tables  with all orders
    /// \param by_sun  a measured zenith luminance is the Sun's; moonlight takes that of `multi`
    void begin(const CieSettings& settings, const AirTables& tables, double eye_height_m,
               double source_elevation_rad, bool by_sun) noexcept;

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
    shaders32::CieSky sky_{};
    bool overcast_ = false;  // type 16
    float scale_ = 0.0F;     // zenith luminance over what the formula says there
};

}  // namespace skyig::render::sky::models
