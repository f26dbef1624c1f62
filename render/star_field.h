// The stars and planets of one frame: turned, lifted and dimmed by the air, sorted out, ready to draw for all
// channels.
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
    glm::vec3 direction_enu;    ///< as it is seen
    glm::vec3 illuminance_lux;  ///< linear Rec.709, behind the air
    glm::vec3 background;       ///< display linear, of the sky behind the star
};

/// Standard deviation of a star's footprint in pixels of the finest channel's axis.
inline constexpr double kStarSigma_px = 0.7;

/// V magnitude of a star that, outside the air, adds half a display code to its brightest pixel before a
/// background of this luminance; fainter ones change no picture.
[[nodiscard]] double half_code_mag(double background_cd_m2, const shaders64::ToneParameters& tone,
                                   double pixel_rad) noexcept;

class StarField {
  public:
    /// Allocates for the whole catalogue and the planets.
    StarField();

    /// \param limit_mag  V magnitude outside the air; fainter ones are left out, brighter ones fade in over
    /// 0.8 mag. Annual aberration of stars: direction + velocity / c, normalised (second order neglected:
    /// 0.001 arcsec). Refraction is interpolated: within 3 arcsec of the frame's row up to FL600.
    void update(const Scene& scene, const sky::AirTables& air, const SkyLight& light,
                const shaders64::ToneParameters& tone, double limit_mag);

    [[nodiscard]] std::span<const StarVertex> stars() const noexcept { return {stars_.data(), count_}; }
    [[nodiscard]] std::size_t capacity() const noexcept { return stars_.size(); }

  private:
    struct Frame;
    /// What the air does to a point of light, over airless elevation.
    struct Air {
        glm::vec3 transmittance;
        float lift_rad;
    };
    void tabulate_air(const SkyLight& light, const sky::AirTables& air);
    [[nodiscard]] Air air_at(double elevation_rad, double lowest_rad) const noexcept;
    void add(const glm::vec3& direction_enu, const glm::vec3& illuminance_lux, const Frame& frame) noexcept;

    struct Source {
        glm::vec3 direction_gcrs;  // J2000
        glm::vec3 motion_rad_per_yr;
        glm::vec3 illuminance_lux;
        float magnitude;
    };
    std::vector<Source> sources_;  // brightest first
    std::vector<StarVertex> stars_;
    std::vector<Air> air_;
    std::size_t count_ = 0;
};

}  // namespace skyig::render
