// The mesh that carries all smooth light: vertices are directions round the eye, colours are toned at the
// vertices, once a frame at most, for all channels. Rows crowd at the horizon and at the height of the light
// source, columns towards its azimuth. Free of GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

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
    /// The light source that the mesh is turned to.
    double source_elevation_rad = 0.0;
    /// Angle over which the horizon's edge is softened, radians.
    double edge_rad = 1e-3;

    friend bool operator==(const DomeLayout&, const DomeLayout&) = default;
};

class Dome {
  public:
    static constexpr int kColumns = 112;
    static constexpr int kSkyRows = 64;
    static constexpr int kGroundRows = 40;

    Dome();

    /// Places the vertices. Columns and rows are counted as above whatever the layout.
    void lay_out(const DomeLayout& layout);
    /// Colours the vertices: display code 0..1, before dither.
    void shade(const SkyLight& light, double source_azimuth_rad, const shaders64::ToneParameters& tone);

    [[nodiscard]] std::span<const DomeVertex> vertices() const noexcept { return vertices_; }
    [[nodiscard]] std::span<const std::uint32_t> indices() const noexcept { return indices_; }
    [[nodiscard]] const DomeLayout& layout() const noexcept { return layout_; }

    /// Turns mesh axes about the vertical so that y points to the source's azimuth.
    [[nodiscard]] static glm::dmat3 enu_from_mesh(double source_azimuth_rad) noexcept;

  private:
    struct Row {
        double elevation_rad;        // of the vertices
        double light_elevation_rad;  // where the colour is taken
        Side side;
    };
    std::vector<Row> rows_;
    std::vector<double> azimuths_rad_;
    std::vector<DomeVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    DomeLayout layout_;
};

}  // namespace skyig::render
