// The day-sky models that are measured, each through the look-ups that the renderer draws with.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

#include "render/sky/air_tables.h"
#include "render/sky/models/day_sky.h"
#include "render/sky_settings.h"

namespace skyig::clients::bench {

struct SkyContestant {
    render::SkyModel model = render::SkyModel::kMulti;
    const char* what = "";
    /// The first of those that share its kind of tables of the air.
    bool builds_air = false;
};

/// From cheap to good.
[[nodiscard]] std::span<const SkyContestant> sky_contestants() noexcept;

/// One model with its tables in one air. Angles and light as render::sky::SkyRadiance has them.
class MeasuredSky {
  public:
    explicit MeasuredSky(render::SkyModel model) { settings_.model = model; }

    /// Another air, with the tables that orders() asks for; nothing is looked up before place().
    void enter(const render::sky::AirTables& air) { air_ = air; }
    [[nodiscard]] render::sky::Orders orders() const {
        return render::sky::models::orders_of(settings_.model);
    }
    /// Tables of another eye and Sun.
    void place(double eye_height_m, double source_elevation_rad);
    [[nodiscard]] glm::vec3 xyz(float elevation_rad, float relative_azimuth_rad) const {
        return sky_.xyz(elevation_rad, relative_azimuth_rad);
    }

  private:
    render::SkySettings settings_;
    std::optional<render::sky::AirTables> air_;
    render::sky::models::DaySky sky_;
};

}  // namespace skyig::clients::bench
