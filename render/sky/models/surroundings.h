// What the closed formulas take from the air around the eye: they know the sky of an eye on the ground by
// day, and this is how they go on beyond it.
#pragma once

#include <glm/glm.hpp>

#include "render/sky/air_tables.h"
#include "render/sky/geometry.h"

namespace skyig::render::sky::models {

/// For one eye and one light source; angles and luminances as in SkyRadiance. Needs tables with all orders.
class Surroundings {
  public:
    Surroundings() = default;
    /// Out-of-range numbers count as the nearest end, what is not finite as the ground and midnight.
    Surroundings(const AirTables& tables, double eye_height_m, double source_elevation_rad) noexcept;

    [[nodiscard]] double horizon_elevation_rad() const noexcept { return horizon_rad_; }
    [[nodiscard]] double source_elevation_rad() const noexcept { return source_elevation_rad_; }

    /// XYZ straight up as `multi` has it: from full day to the end of twilight, dark where no air is left
    /// above.
    [[nodiscard]] const glm::vec3& zenith_xyz() const noexcept { return zenith_xyz_; }
    /// XYZ of the lit ground under the eye, a Lambert surface of the air's albedo, without air before it.
    [[nodiscard]] const glm::vec3& ground_xyz() const noexcept { return ground_xyz_; }

    /// Part of the air's vertical optical depth (558 nm) that is above the eye: 1 on the ground, 0 at the
    /// lid.
    [[nodiscard]] double air_above() const noexcept { return air_above_; }

    /// How twilight fades what a formula says of a low Sun: diffuse illuminance of the ground over that with
    /// the source at `last_rad`, and 1 above that elevation. `tables` as at construction.
    [[nodiscard]] double fade_below(const AirTables& tables, double last_rad) const noexcept;

    /// Distance to the ground, and the part of its light (558 nm) that the air between leaves over.
    [[nodiscard]] double ground_distance_m(float elevation_rad) const noexcept;
    [[nodiscard]] float ground_share(float elevation_rad) const noexcept;

  private:
    double eye_height_m_ = 0.0;
    double source_elevation_rad_ = 0.0;
    double horizon_rad_ = 0.0;
    Shell shell_{};
    glm::vec3 zenith_xyz_{0.0F};
    glm::vec3 ground_xyz_{0.0F};
    double air_above_ = 0.0;
    double extinction_per_m_ = 0.0;  // mean from the eye down to the ground
};

/// Light of the ground seen through air that itself looks like the sky on the horizon.
[[nodiscard]] glm::vec3 hazy_ground(const Surroundings& at, float elevation_rad,
                                    const glm::vec3& horizon_xyz) noexcept;

/// An elevation that is finite but out of range, brought to the side that is asked for.
[[nodiscard]] float clamped_above(const Surroundings& at, float elevation_rad) noexcept;
[[nodiscard]] float clamped_below(const Surroundings& at, float elevation_rad) noexcept;

}  // namespace skyig::render::sky::models
