// Model `daycycle`: singly scattered light in tables along the Sun's path, two of them mixed.
#pragma once

#include "render/sky/sky_radiance.h"
#include "render/sky/sky_view.h"
#include "render/sky_settings.h"

namespace skyig::render::sky::models {

/// Places on the path are numbered from the zenith down: equally far apart in air mass, and never more than
/// some degrees; below the horizon the air mass goes on in a straight line. So the light of neighbours
/// differs by much the same factor everywhere. From high up the Sun sets over the far horizon long before it
/// does at the eye: there the air mass is that of a Sun lower by the dip. \param elevation_rad  -pi/2..pi/2;
/// \param dip_rad  of the eye's horizon, >= 0
[[nodiscard]] double day_path_place(double elevation_rad, double dip_rad) noexcept;
/// Inverse of the above.
[[nodiscard]] double day_path_elevation_rad(double place, double dip_rad) noexcept;

/// Two tables of direction (elevation by azimuth) hold Rayleigh and Mie light of the Sun at the two places
/// around its own; between them it is linear in the place, the aerosol's phase function exact. As the Sun
/// passes a place, one table is built anew, in slices; a table serves as long as the eye's height does.
/// Limits: as `single`, 25 % too dark at noon and worse in twilight, too blue (`desaturation` hides it).
class DayCycle final : public SkyRadiance {
  public:
    explicit DayCycle(const SkyViewSize& size = {}) : before_(size), after_(size) {}

    /// \param tables  with the first order alone. Parameters as SkyView::begin().
    void begin(const DayCycleSettings& settings, const AirTables& tables, double eye_height_m,
               double source_elevation_rad) noexcept;
    /// At most `max_rows` more rows; true when both tables are complete.
    bool build_rows(int max_rows) noexcept;

    [[nodiscard]] glm::vec3 xyz_above(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] glm::vec3 xyz_below(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] double horizon_elevation_rad() const noexcept override {
        return before_.view.horizon_elevation_rad();
    }

    /// Tables begun so far: what the Sun's way has cost.
    [[nodiscard]] int tables_begun() const noexcept { return tables_begun_; }

  private:
    struct Place {
        explicit Place(const SkyViewSize& size) : view(size) {}

        SkyView view;
        int number = 0;
        bool made = false;
    };
    void renew(Place& place, int number, const AirTables& tables) noexcept;
    [[nodiscard]] glm::vec3 mixed(const SkyParts& before, const SkyParts& after, float elevation_rad,
                                  float relative_azimuth_rad) const noexcept;

    Place before_;
    Place after_;
    // What both are made for; the views keep the air alive.
    const AirData* air_ = nullptr;
    double height_m_ = 0.0;
    float after_share_ = 0.0F;
    float g_ = 0.0F;
    float source_sine_ = 0.0F;
    float source_cosine_ = 1.0F;
    float desaturation_ = 0.0F;
    int tables_begun_ = 0;
};

}  // namespace skyig::render::sky::models
