// What direction each pixel of a channel shows, read back from a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "render/gl/draw.h"
#include "render/refined_mesh.h"
#include "render/warp_pass.h"
#include "tests/render/scenes.h"

namespace skyig::render::tests {

inline double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kDegree;
}

/// A dome of cells of 10 deg whose colours are its directions, drawn as the sky's own dome is.
class DirectionDome {
  public:
    explicit DirectionDome(bool refines) : mesh_({3, 3, 3}, kCount, refines) {}

    /// \param truth  direction in the view frame that a place of the screen should show
    double worst_error_deg(const Channel& channel, const ChannelView& view, double longest_rad,
                           const std::function<glm::dvec3(const glm::dvec2&)>& truth) {
        place(longest_rad);
        const gl::Program program("sky/dome.vert", "sky/dome.frag", gl::Placement::kWarped);
        const WarpPass warps({&channel, 1});
        gl::Framebuffer target(channel.width_px, channel.height_px, gl::PixelFormat::kRgba32F);
        gl::set_common_state();
        gl::set_blend(gl::Blend::kReplace);
        target.bind();
        warps.bind(0);
        const ImagePlane p = image_plane(view.frustum);
        const glm::dmat4 clip{
            glm::dvec4{2.0 / (p.right - p.left), 0.0, 0.0, 0.0},
            {0.0, 2.0 / (p.top - p.bottom), 0.0, 0.0},
            {(p.right + p.left) / (p.right - p.left), (p.top + p.bottom) / (p.top - p.bottom), 0.0, -1.0},
            glm::dvec4{0.0}};
        program.set(program.uniform("u_clip_from_mesh"), glm::mat4{clip * glm::dmat4{view.view_from_enu}});
        program.use();
        mesh_.draw({0, indices_.size()});
        std::vector<float> rgb(static_cast<std::size_t>(channel.width_px) *
                               static_cast<std::size_t>(channel.height_px) * 3);
        target.read_rgb32f(rgb);
        return worst(channel, view, rgb, truth);
    }

  private:
    static constexpr std::uint32_t kColumns = 36;
    static constexpr std::uint32_t kRows = 18;
    static constexpr std::size_t kCount = std::size_t{kColumns + 1} * (kRows + 1);

    void place(double longest_rad) {
        std::vector<float> vertices;
        indices_.clear();
        for (std::uint32_t row = 0; row <= kRows; ++row) {
            for (std::uint32_t column = 0; column <= kColumns; ++column) {
                const glm::vec3 d{at(10.0 * row - 90.0, 10.0 * column)};
                // Directions, and twice the same as a colour that never fades.
                for (int copy = 0; copy < 3; ++copy)
                    vertices.insert(vertices.end(), {d.x, d.y, d.z});
                if (row == kRows || column == kColumns) continue;
                const std::uint32_t low = row * (kColumns + 1) + column;
                for (const std::uint32_t i : {0U, 1U, kColumns + 1, kColumns + 1, 1U, kColumns + 2})
                    indices_.push_back(low + i);
            }
        }
        mesh_.set_triangles(indices_, vertices, longest_rad);
    }

    static double worst(const Channel& channel, const ChannelView& view, const std::vector<float>& rgb,
                        const std::function<glm::dvec3(const glm::dvec2&)>& truth) {
        const glm::dmat3 enu_from_view = glm::transpose(view.view_from_enu);
        double worst_deg = 0.0;
        const float* d = rgb.data();
        for (int y = 0; y < channel.height_px; ++y) {
            for (int x = 0; x < channel.width_px; ++x, d += 3) {
                const glm::dvec2 screen{(x + 0.5) / channel.width_px, 1.0 - (y + 0.5) / channel.height_px};
                worst_deg = std::max(worst_deg, angle_deg({d[0], d[1], d[2]}, enu_from_view * truth(screen)));
            }
        }
        return worst_deg;
    }

    RefinedMesh mesh_;
    std::vector<std::uint32_t> indices_;
};

}  // namespace skyig::render::tests
