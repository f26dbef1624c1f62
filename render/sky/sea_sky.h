// The sky as the sea's surface sees it, for every elevation of the source at once: what waves reflect, also
// far from the eye, where the source stands higher or lower.
#pragma once

#include <glm/glm.hpp>

#include "render/sky/air_data.h"

namespace skyig::render::sky {

/// Fills `data.sea_sky`; needs columns and moments. About a tenth of the work of the moments.
void build_sea_sky(AirData& data);

/// Look-ups for one elevation of the source.
class SeaSky {
  public:
    /// \param data  with a sea sky; outlives this
    /// \param source_sine  of its elevation where the surface is
    SeaSky(const AirData& data, double source_sine) noexcept;

    /// XYZ, Y in cd/m2, source as the Sun at 1 AU, of the direction with this sine of elevation (0..1) and
    /// cosine of azimuth from the source's. >= 0.
    [[nodiscard]] glm::vec3 xyz(float sine, float azimuth_cosine) const noexcept;

  private:
    const AirData& data_;
    float source_sine_;
    float source_level_;
    int low_;
    float part_;
};

}  // namespace skyig::render::sky
