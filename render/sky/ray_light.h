// Light along one ray, without a table of directions: what the air does to an object at a finite distance,
// and the exact value that the tables interpolate.
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "render/sky/air_tables.h"

namespace skyig::render::sky {

/// Where a ray starts and what it looks at, beside the air. Angles as in SkyRadiance.
struct RayQuery {
    double eye_height_m = 0.0;
    double source_elevation_rad = 0.0;
    double elevation_rad = 0.0;
    double relative_azimuth_rad = 0.0;
    /// To the object; the ray ends at the ground if that is nearer. >= 0.
    double distance_m = std::numeric_limits<double>::infinity();
    /// False: the air alone, also where the ray ends at the ground; what stands there is the caller's.
    bool ground = true;
};

struct RayLight {
    /// XYZ in cd/m2, source as the Sun at 1 AU: what the air sends into the ray and, where the ray reaches
    /// the ground, the lit ground behind that air.
    glm::dvec3 xyz{0.0};
    /// Part of an object's own light that arrives, at the carried wavelengths. What the aerosol scatters by
    /// small angles counts as lost: sharp contrast is what visibility is about.
    Spectrum transmittance{};
    /// The same without that loss: what `xyz` was marched with.
    Spectrum diffuse_transmittance{};
    bool meets_ground = false;
};

/// Marches the orders that the tables hold (48 steps, about 15 us). Any input is legal, out-of-range numbers
/// count as the nearest end; angles that are not finite give darkness and full transmittance. Nothing
/// allocates.
[[nodiscard]] RayLight ray_light(const AirTables& tables, const RayQuery& query) noexcept;

/// A spectral transmittance as factors on linear Rec.709 of a surface in sunlight. >= 0.
[[nodiscard]] glm::dvec3 transmittance_rgb(const AirModel& model, const Spectrum& transmittance) noexcept;

}  // namespace skyig::render::sky
