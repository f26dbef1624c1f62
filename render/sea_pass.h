// Draws the dome's triangles where waves are seen one by one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "render/channel.h"
#include "render/discs.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/sky_frame.h"

namespace skyig::render {

class SeaPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    SeaPass();

    /// Once a frame that has rows of sea, after SkyFrame::prepare().
    void prepare(const SkyFrame& frame, bool dither);
    /// Into the framebuffer that is bound, without blending. \param ranges  of the dome's indices
    void draw(const Channel& channel, const glm::dmat4& clip_from_mesh,
              std::span<const IndexRange> ranges) const;

  private:
    gl::Program program_;
    gl::Mesh mesh_;
    ToneUniforms tone_;
    int clip_, enu_, share_, half_size_, dither_, height_, curvature_, pixel_, source_, variance_, phases_,
        shapes_;
    std::uint64_t vertices_revision_ = 0;
    std::uint64_t triangles_revision_ = 0;
};

}  // namespace skyig::render
