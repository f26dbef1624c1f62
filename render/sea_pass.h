// Draws the dome's triangles where waves are seen one by one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/channel.h"
#include "render/discs.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/sky_frame.h"

namespace skyig::render {

class SeaPass {
  public:
    /// \param screens  as the frame's \throws std::runtime_error when the program cannot be made
    explicit SeaPass(std::size_t screens);

    /// Once a frame that has rows of sea, after SkyFrame::prepare().
    void prepare(const SkyFrame& frame, bool dither);
    /// Into the framebuffer that is bound, without blending. \param ranges  of the dome's indices
    void draw(const Channel& channel, std::size_t screen, const shaders32::ToneParameters& tone,
              const glm::dmat4& clip_from_mesh, std::span<const IndexRange> ranges) const;

  private:
    gl::Program program_;
    std::vector<gl::Mesh> meshes_;  // by screen
    ToneUniforms tone_;
    int clip_, enu_, share_, half_size_, dither_, height_, curvature_, pixel_, source_, variance_, phases_,
        shapes_;
    std::uint64_t vertices_revision_ = 0;
    std::uint64_t triangles_revision_ = 0;
};

}  // namespace skyig::render
