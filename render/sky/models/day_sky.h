// The day sky of whichever model the settings name, as the renderer keeps it.
#pragma once

#include <memory>

#include "render/sky/sky_radiance.h"
#include "render/sky/sky_view.h"
#include "render/sky_settings.h"

namespace skyig::render::sky {

enum class Orders;

namespace models {

/// Which tables of the air a model needs.
[[nodiscard]] Orders orders_of(SkyModel model) noexcept;

/// begin() and build_rows() spread one build over frames; look-ups are answered once build_rows() has
/// returned true and do not depend on how the build was sliced. Only the constructor allocates. Double
/// buffering is the caller's.
class DaySky final : public SkyRadiance {
  public:
    /// \param size  of the tables of the models that have some
    explicit DaySky(const SkyViewSize& size = {});
    ~DaySky() override;
    DaySky(const DaySky&) = delete;
    DaySky& operator=(const DaySky&) = delete;
    DaySky(DaySky&&) noexcept;
    DaySky& operator=(DaySky&&) noexcept;

    /// \param tables  with orders_of(settings.model)
    /// \param eye_height_m, source_elevation_rad  as SkyView::begin()
    /// \param by_sun  false: moonlight
    void begin(const SkySettings& settings, const AirTables& tables, double eye_height_m,
               double source_elevation_rad, bool by_sun) noexcept;
    /// At most `max_rows` more rows of a table, if the model has tables; true when it is complete.
    bool build_rows(int max_rows) noexcept;
    void build_all() noexcept;

    [[nodiscard]] glm::vec3 xyz_above(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] glm::vec3 xyz_below(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] double horizon_elevation_rad() const noexcept override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace models

}  // namespace skyig::render::sky
