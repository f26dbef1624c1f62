// Draws the dome's triangles where waves are seen one by one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/channel.h"
#include "render/discs.h"
#include "render/gl/program.h"
#include "render/refined_mesh.h"
#include "render/sky_frame.h"

namespace skyig::render {

class SeaPass {
  public:
    /// \param screens  as the frame's \throws std::runtime_error when the program cannot be made
    SeaPass(std::size_t screens, gl::Placement placement);

    /// Once a frame that has rows of sea, after SkyFrame::prepare(). \param longest_edge_rad  of a triangle
    void prepare(const SkyFrame& frame, bool dither, double longest_edge_rad);
    /// Into the framebuffer that is bound, without blending. \param ranges  of the dome's indices
    void draw(const Channel& channel, std::size_t screen, const shaders32::ToneParameters& tone,
              const glm::dmat4& clip_from_mesh, std::span<const IndexRange> ranges) const;

  private:
    gl::Program program_;
    std::vector<RefinedMesh> meshes_;  // by screen
    ToneUniforms tone_;
    int clip_, enu_, share_, half_size_, dither_, height_, curvature_, pixel_, source_, variance_, phases_,
        shapes_;
    std::uint64_t vertices_revision_ = 0;
    std::uint64_t triangles_revision_ = 0;
    double longest_edge_rad_ = 0.0;
    int rows_ = 0;
};

}  // namespace skyig::render
