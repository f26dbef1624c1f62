// Draws the veil of glare round one source; blended by adding.
#pragma once

#include <glm/glm.hpp>

#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/glare.h"

namespace skyig::render {

class GlarePass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    explicit GlarePass(gl::Placement placement);

    void prepare(const Glare& glare, double pixel_rad, bool dither);
    void draw(const glm::mat4& clip_from_enu) const;
    /// The same but for the disc itself.
    void draw_around(const glm::mat4& clip_from_enu) const;

  private:
    void draw(const glm::mat4& clip_from_enu, std::size_t first) const;

    gl::Program program_;
    gl::Mesh rings_;
    int clip_, source_, horizon_sin_, inv_softness_, dither_;
};

}  // namespace skyig::render
