// What depends on the air alone: optical columns towards a light source, and the light that has been
// scattered more than once, as the first moments of its angular distribution. Built once per change of
// weather, then shared by every sky view.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "render/sky/air_model.h"

namespace skyig::render::sky {

struct AirData;

/// Which scatterings are followed.
enum class Orders {
    kFirst,  ///< light scattered once, and ground lit by the source alone
    kAll,
};

/// Immutable; copies share the tables, so a table may be built on one thread and handed to another.
///
/// Heights are metres above the model's ground (below 0 counts as the ground). Every function takes any
/// finite argument and returns finite values >= 0.
class AirTables {
  public:
    /// Builds everything; the only member that allocates. About 100 ms on one core (AVX-512; AVX2 140,
    /// portable 255), up to twice that in haze, which takes more orders; the first order alone takes a
    /// quarter. Transmittance errs by less than 0.003 (p99).
    explicit AirTables(const AirModel& model, Orders orders = Orders::kAll);

    [[nodiscard]] const AirModel& model() const noexcept;
    [[nodiscard]] Orders orders() const noexcept;

    /// Part of the light that reaches `height_m` from a small body seen at `elevation_rad`: through all the
    /// air along the curved ray, falling smoothly to 0 over the width of the Sun's disc about the horizon
    /// (0.27 deg each way). The horizon is the geometric one: below the level, angles are those of the
    /// straight ray that comes as near to the ground (SkyLight::straight_elevation_rad()).
    [[nodiscard]] Spectrum transmittance(double height_m, double elevation_rad) const noexcept;

    /// The same at the effective wavelengths of linear red, green and blue for starlight: 612, 549, 465 nm.
    [[nodiscard]] glm::dvec3 transmittance_rgb(double height_m, double elevation_rad) const noexcept;

    /// XYZ illuminance (Y in lux) of the unobscured solar disc on a plane facing it. distance_au > 0.
    [[nodiscard]] glm::dvec3 direct_sun_xyz(double height_m, double elevation_rad,
                                            double distance_au = 1.0) const noexcept;

    /// XYZ illuminance (Y in lux) on level ground at height 0 from the sky alone, Sun at 1 AU, by the
    /// elevation that the source would be seen at without air; 0 where only the first order is followed.
    [[nodiscard]] glm::dvec3 ground_diffuse_xyz(double source_elevation_rad) const noexcept;

    /// For sky views (same folder).
    [[nodiscard]] const AirData& data() const noexcept { return *data_; }
    [[nodiscard]] std::shared_ptr<const AirData> share() const noexcept { return data_; }

  private:
    std::shared_ptr<const AirData> data_;
};

}  // namespace skyig::render::sky
