// The light of a scene that stands still, as frames have it once all their tables are at rest: what tools and
// tests hold against measurements.
#pragma once

#include <glm/glm.hpp>

#include "render/light_tables.h"
#include "render/milky_way.h"
#include "render/scene.h"
#include "render/sky_light.h"

namespace skyig::render {

class StillLight {
  public:
    /// Builds what the scene needs; light() is then its own, the Milky Way with it where the scene draws each
    /// source by its own law. Later scenes must have the air of the first. Throws std::bad_alloc.
    void settle(const Scene& scene);

    // All of this is the settled scene's.
    [[nodiscard]] const SkyLight& light() const noexcept { return light_; }
    [[nodiscard]] const sky::AirTables& air() const noexcept { return tables_.air(); }
    /// Luminance straight up.
    [[nodiscard]] double zenith_cd_m2() const noexcept;
    /// Illuminance of level ground at the eye: by the sky without discs and stars, by the Sun's disc, by the
    /// Moon's.
    [[nodiscard]] double sky_lux() const noexcept;
    [[nodiscard]] double sun_lux() const noexcept;
    [[nodiscard]] double moon_lux() const noexcept;

  private:
    /// By the Sun's disc 1 AU away in that direction.
    [[nodiscard]] double disc_lux(const glm::dvec3& direction_enu) const noexcept;

    LightTables tables_;
    MilkyWay milky_way_;
    Scene scene_;
    SkyLight light_;
};

}  // namespace skyig::render
