// The mesh that carries all smooth light: vertices are directions round the eye, colours are toned at the
// vertices, once a frame at most, for all channels. Rows crowd at the horizon and at the height of the light
// source, columns towards its azimuth. Free of GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/dome_patches.h"
#include "render/shaders/shared.h"
#include "render/sky_light.h"

namespace skyig::render {

/// As the vertex shader sky/dome.vert takes it. Mesh frame: y towards the light source's azimuth, z up.
struct DomeVertex {
    glm::vec3 direction;
    glm::vec3 encoded;
};

/// What decides where rows and columns lie.
struct DomeLayout {
    double horizon_elevation_rad = 0.0;
    /// Angle over which the horizon's edge is softened, radians.
    double edge_rad = 1e-3;
    /// The light source that the mesh is turned to, and whether it draws vertices to itself.
    double first_elevation_rad = 0.0;
    bool first_lights = false;
    /// A second one, its azimuth from the first.
    double second_elevation_rad = 0.0;
    double second_azimuth_rad = 0.0;
    bool second_lights = false;
    /// The ground mirrors them: finer rows where, finer columns below them.
    bool sea = false;
    double first_mirror_rad = -1.5;
    double second_mirror_rad = -1.5;
};

/// Where the mesh is best laid for this light: turned to the Sun if it lights the air, else to the Moon.
[[nodiscard]] DomeLayout dome_layout(const SkyLight& light, double edge_rad) noexcept;
/// Azimuth that the mesh of dome_layout() is turned to.
[[nodiscard]] double dome_azimuth_rad(const SkyLight& light) noexcept;
/// Whether a mesh laid out for `held` still serves `wanted`: no edge off by 1/20 of its softening, no source
/// by 0.3 deg.
[[nodiscard]] bool still_serves(const DomeLayout& held, const DomeLayout& wanted) noexcept;

class Dome {
  public:
    static constexpr int kColumns = 112;
    static constexpr int kSkyRows = 64;
    static constexpr int kGroundRows = 40;

    Dome();

    /// Places the vertices. Columns and rows are counted as above whatever the layout.
    void lay_out(const DomeLayout& layout);
    /// Colours the vertices: display code 0..1, before dither.
    void shade(const SkyLight& light, const shaders64::ToneParameters& tone);

    [[nodiscard]] std::span<const DomeVertex> vertices() const noexcept { return vertices_; }
    [[nodiscard]] std::span<const std::uint32_t> indices() const noexcept { return patches_.indices(); }
    /// What of the indices a view needs; valid until the next call. \param clip_from_mesh  as the vertex
    /// shader has it
    [[nodiscard]] std::span<const IndexRange> visible(const glm::dmat4& clip_from_mesh) noexcept {
        return patches_.visible(clip_from_mesh);
    }
    [[nodiscard]] const DomeLayout& layout() const noexcept { return layout_; }

    /// Turns mesh axes about the vertical so that y points to `azimuth_rad`.
    [[nodiscard]] static glm::dmat3 enu_from_mesh(double azimuth_rad) noexcept;

  private:
    struct Row {
        double elevation_rad;      // of the vertices
        double above_horizon_rad;  // where the colour is taken
        Side side;
    };
    std::vector<Row> rows_;
    std::vector<double> azimuths_rad_;
    std::vector<DomeVertex> vertices_;
    DomePatches patches_{kSkyRows + kGroundRows - 1, kColumns};
    std::vector<glm::vec3> directions_;
    DomeLayout layout_;
};

}  // namespace skyig::render
