#include "render/sea_mesh.h"

#include <algorithm>
#include <cmath>

namespace skyig::render {

int SeaMesh::rows(const Dome& dome, const sky::SeaWaves& waves, double height_m, double pixel_rad) noexcept {
    if (waves.count == 0) return 0;
    const double number = glm::length(waves.trains.front().number_rad_m);
    const double sine = sky::least_depression_sine(height_m, number, pixel_rad);
    const std::size_t stride = static_cast<std::size_t>(dome.size().columns) + 1;
    int row = 0;
    while (row<dome.size().ground_rows&& static_cast<double>(
               -dome.vertices()[static_cast<std::size_t>(row) * stride].direction.z)>
               sine)
        ++row;
    constexpr int kSide = static_cast<int>(DomePatches::kSide);
    return std::min((row + kSide - 1) / kSide * kSide, dome.size().ground_rows / kSide * kSide);
}

SeaMesh::SeaMesh(std::size_t screens) : vertices_(screens) {
    for (auto& vertices : vertices_)
        vertices.reserve(kMaxVertices);
}

void SeaMesh::lay_out(const Dome& dome, const SkyLight& light, double azimuth_rad, int rows) {
    std::vector<SeaVertex>& vertices = vertices_.front();
    vertices.resize(static_cast<std::size_t>(rows + 1) * (static_cast<std::size_t>(dome.size().columns) + 1));
    const double risen = light.horizon_elevation_rad - dome.layout().horizon_elevation_rad;
    const bool fades = dome.share() < 1.0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        SeaVertex& vertex = vertices[i];
        const Horizontal at = horizontal_of(glm::dvec3{dome.vertices()[i].direction});
        const SlopeLight slopes = light.of_slopes(at.elevation_rad + risen, azimuth_rad + at.azimuth_rad);
        vertex.smooth_to = slopes.without_glitter(dome.light()[i]);
        vertex.smooth_from = fades ? slopes.without_glitter(dome.light_before()[i]) : vertex.smooth_to;
        vertex.east = slopes.east;
        vertex.north = slopes.north;
        vertex.bend = slopes.bend_cd_m2 / std::max(shaders32::luminance_709(vertex.smooth_to), 1e-12F);
        vertex.glitter = slopes.glitter;
    }
    for (std::size_t screen = 1; screen < vertices_.size(); ++screen)
        vertices_[screen].assign(vertices.begin(), vertices.end());
    colour(dome);
}

void SeaMesh::colour(const Dome& dome) noexcept {
    for (std::size_t screen = 0; screen < vertices_.size(); ++screen) {
        const auto coloured = dome.vertices(screen);
        for (std::size_t i = 0; i < vertices_[screen].size(); ++i)
            vertices_[screen][i].dome = coloured[i];
    }
}

}  // namespace skyig::render
