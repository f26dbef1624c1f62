// The stars of one frame: turned, dimmed by the air, sorted out, ready to draw for all channels.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky/air_tables.h"
#include "render/sky_light.h"

namespace skyig::render {

/// As the vertex shader night/star.vert takes it.
struct StarVertex {
    glm::vec3 direction_enu;
    glm::vec3 illuminance_lux;  ///< linear Rec.709, behind the air
    glm::vec3 background;       ///< display linear, of the sky behind the star
};

class StarField {
  public:
    /// Allocates for the whole catalogue.
    StarField();

    /// \param limit_mag  V magnitude outside the air; fainter stars are left out, brighter ones fade in over
    /// 0.8 mag Annual aberration: direction + velocity / c, normalised (second order neglected: 0.001
    /// arcsec).
    void update(const Scene& scene, const sky::AirTables& air, const SkyLight& light,
                const shaders64::ToneParameters& tone, double limit_mag);

    [[nodiscard]] std::span<const StarVertex> stars() const noexcept { return {stars_.data(), count_}; }
    [[nodiscard]] std::size_t capacity() const noexcept { return stars_.size(); }

  private:
    void tabulate_transmittance(const SkyLight& light, const sky::AirTables& air);
    [[nodiscard]] glm::vec3 transmittance(double elevation_rad, double horizon_rad) const noexcept;

    struct Source {
        glm::vec3 direction_gcrs;  // J2000
        glm::vec3 motion_rad_per_yr;
        glm::vec3 illuminance_lux;
        float magnitude;
    };
    std::vector<Source> sources_;  // brightest first
    std::vector<StarVertex> stars_;
    std::vector<glm::vec3> transmittance_;
    std::size_t count_ = 0;
};

}  // namespace skyig::render
