// The sky in wet things of another renderer that face up and lie open.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/channel.h"
#include "render/deferred.h"
#include "render/discs.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/precipitation/exposure.h"
#include "render/precipitation/ripples.h"
#include "render/scene.h"
#include "render/sky_light.h"
#include "render/thing_surface.h"

namespace skyig::render {

class WetPass {
  public:
    /// \throws std::runtime_error when the program or the textures cannot be made
    WetPass();

    /// Once a frame whose plan needs it, with light whose film is not 0.
    void prepare(const Scene& scene, const SkyLight& light, const precipitation::ExposureView& exposure);
    /// Blends by coverage over things that have been drawn, into the framebuffer that is bound.
    void draw(const Channel& channel, const ChannelView& view, const shaders32::ToneParameters& tone,
              const DeferredInput& input) const;

  private:
    /// Of the texture of the sky: azimuths from north clockwise, the first once more at the end, by sines of
    /// elevation from 0 to 1.
    static constexpr int kColumns = 48;
    static constexpr int kRows = 16;

    gl::Program program_;
    gl::Mesh triangle_;
    ToneUniforms tone_;
    ThingSurface surface_;
    int film_, extinction_, anchor_, pixel_;
    precipitation::ExposureView exposure_;
    gl::Texture sky_;
    gl::Texture slopes_;
    std::vector<float> texels_;
    precipitation::Ripples ripples_;
};

}  // namespace skyig::render
