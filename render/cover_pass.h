// Another renderer's things under water and snow: their light before the air is put over it.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "render/channel.h"
#include "render/deferred.h"
#include "render/gl/framebuffer.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/precipitation/exposure.h"
#include "render/scene.h"
#include "render/thing_surface.h"

namespace skyig::render {

/// Level things that lie open are darkened by water as Angstrom's film has it, their albedo being what they
/// show of `white_cd_m2`; snow lies on what faces up, as bright as the snow of our own ground.
class CoverPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    explicit CoverPass(std::size_t channels);

    /// Once a frame whose plan needs it. \param white_cd_m2  white_ground_cd_m2()
    void prepare(const Scene& scene, const glm::dvec3& white_cd_m2,
                 const precipitation::ExposureView& exposure);
    /// Without blending; binds a framebuffer of its own. \throws std::runtime_error when that cannot be made
    /// \return the same picture, its colours changed
    [[nodiscard]] DeferredInput draw(std::size_t index, const Channel& channel, const ChannelView& view,
                                     const DeferredInput& input);

  private:
    gl::Program program_;
    gl::Mesh triangle_;
    ThingSurface surface_;
    int white_, snow_, wet_;
    precipitation::ExposureView exposure_;
    std::vector<std::optional<gl::Framebuffer>> pictures_;  // once a channel is drawn
};

}  // namespace skyig::render
