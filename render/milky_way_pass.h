// Draws the Milky Way's belt into a channel, by adding.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "render/channel.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/milky_way.h"

namespace skyig::render {

class MilkyWayPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    explicit MilkyWayPass(std::size_t screens);

    /// Uploads what has changed. \param light  of the frame
    void prepare(const MilkyWay& milky_way, const SkyLight& light, bool dither);
    /// Draws nothing where the belt is out of view.
    void draw(MilkyWay& milky_way, const Channel& channel, std::size_t screen,
              const glm::dmat4& clip_from_enu) const;

  private:
    gl::Program program_;
    std::vector<gl::Mesh> meshes_;  // one a screen
    std::optional<gl::Texture> map_;
    std::uint64_t map_revision_ = 0;
    glm::dmat3 enu_from_galactic_{1.0};
    int clip_, half_size_, up_, horizon_sine_, place_scale_, place_shift_, dither_;
};

}  // namespace skyig::render
