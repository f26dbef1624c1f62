// What passes over another renderer's things need to know of their surfaces, as textures and uniforms of a
// program that includes precipitation/things.glsl.
#pragma once

#include <glm/glm.hpp>

#include "render/channel.h"
#include "render/deferred.h"
#include "render/gl/program.h"
#include "render/precipitation/exposure.h"

namespace skyig::render {

class ThingSurface {
  public:
    explicit ThingSurface(const gl::Program& program);

    /// For the draw that follows: depths in unit 0, the map from above in unit 3.
    void bind(const gl::Program& program, const Channel& channel, const ChannelView& view,
              const DeferredInput& input, const precipitation::ExposureView& exposure) const;

  private:
    int centre_, right_, up_, size_, exposure_, exposure_px_, bias_;
};

}  // namespace skyig::render
