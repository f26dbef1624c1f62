// Draws a test pattern in place of the sky. \see pattern/pattern.h
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "render/channel.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"

namespace skyig::render {

class PatternPass {
  public:
    /// \throws std::runtime_error when a program cannot be made
    explicit PatternPass(gl::Placement placement = gl::Placement::kFlat);

    /// Onto a bound picture. \param drawn, view  as they are drawn \param index  of the channel: each has a
    /// colour of its own in patterns of seams
    void draw(const Channel& drawn, const ChannelView& view, const glm::dmat4& clip_from_enu,
              const Screen& screen, std::size_t index) const;

  private:
    void draw_directions(const Channel& drawn, const ChannelView& view, const glm::dmat4& clip_from_enu,
                         float pattern, const glm::vec3& colour) const;

    gl::Program directions_;
    int plane_, enu_from_view_, clip_from_enu_, direction_pattern_, direction_colour_, direction_size_;
    gl::Program pixels_;
    int pixel_pattern_, pixel_colour_, pixel_size_, pixel_gamma_;
    gl::Mesh grid_;
};

}  // namespace skyig::render
