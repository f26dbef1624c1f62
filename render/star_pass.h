// Draws stars and planets into a channel.
#pragma once

#include <cstddef>

#include "render/channel.h"
#include "render/cloud_pass.h"
#include "render/discs.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky_frame.h"
#include "render/star_field.h"

namespace skyig::render {

class StarPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    explicit StarPass(gl::Placement placement);

    /// Once a frame whose plan needs the stars.
    void prepare(const Scene& scene, const SkyFrame& frame, double pixel_rad);
    /// Blends by adding, into the framebuffer and the viewport that are bound: the channel's, whole.
    /// \param clouds  the map that is bound; null: there are none
    void draw(const Channel& channel, const ChannelView& view, const shaders32::ToneParameters& tone,
              const CloudPass* clouds) const;

    [[nodiscard]] std::size_t count() const noexcept { return field_.stars().size(); }

  private:
    StarField field_;
    gl::Program program_;
    gl::Mesh mesh_;
    ToneUniforms tone_;
    CloudFetch fetch_;
    int enu_, clouds_shown_, view_, size_, plane_origin_, plane_step_, peak_gain_;
};

}  // namespace skyig::render
