// The dome's vertices where waves are seen one by one, with what slopes change of their light. Free of GL.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/dome.h"
#include "render/sky/sea_waves.h"
#include "render/sky_light.h"

namespace skyig::render {

/// As the vertex shader sky/sea.vert takes it: shaders' WaveLight beside the dome's colours, linear Rec.709.
struct SeaVertex {
    DomeVertex dome;
    glm::vec3 smooth_from;  ///< at the begin of the dome's fade and at its end
    glm::vec3 smooth_to;
    glm::vec3 east;
    glm::vec3 north;
    glm::vec3 bend;
    glm::vec3 glitter;
};

class SeaMesh {
  public:
    static constexpr std::size_t kMaxVertices = static_cast<std::size_t>(DomeBend::kMost.ground_rows + 1) *
                                                static_cast<std::size_t>(DomeBend::kMost.columns + 1);

    /// Rows of the dome's quads, from the nadir, in which the longest train is resolved: whole patches, at
    /// most those below the horizon. None without waves.
    [[nodiscard]] static int rows(const Dome& dome, const sky::SeaWaves& waves, double height_m,
                                  double pixel_rad) noexcept;

    /// Allocates for the largest dome; nothing later does. \param screens  as the dome's
    explicit SeaMesh(std::size_t screens = 1);

    /// \param azimuth_rad  of the dome's mesh in this frame; \param rows  of quads
    void lay_out(const Dome& dome, const SkyLight& light, double azimuth_rad, int rows);
    /// Takes over the dome's colours alone. Precondition: laid out for this dome.
    void colour(const Dome& dome) noexcept;

    [[nodiscard]] std::span<const SeaVertex> vertices(std::size_t screen = 0) const noexcept {
        return vertices_[screen];
    }

  private:
    std::vector<std::vector<SeaVertex>> vertices_;  // by screen
};

}  // namespace skyig::render
