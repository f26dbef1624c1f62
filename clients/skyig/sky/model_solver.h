// Rows answered by what the renderer draws with: the models' own tables and look-ups.
#pragma once

#include "clients/skyig/sky/atmosphere.h"
#include "clients/skyig/sky/cases.h"
#include "render/sky/air_tables.h"
#include "render/sky/models/day_sky.h"

namespace skyig::clients::sky {

/// The eye of altitude 0 stands on the model's ground; no refraction.
class ModelSolver final : public Solver {
  public:
    /// \param atmosphere  its `sky.model` is the model
    explicit ModelSolver(const Atmosphere& atmosphere);

    void begin(double altitude_m, double sun_zenith_deg) override;
    [[nodiscard]] glm::dvec3 xyz(double view_zenith_deg, double rel_azimuth_deg) override;

  private:
    render::SkySettings settings_;
    render::sky::AirTables tables_;
    render::sky::models::DaySky sky_;
};

}  // namespace skyig::clients::sky
