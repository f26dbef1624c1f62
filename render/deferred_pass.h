// Draws another renderer's picture under our air.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/deferred.h"
#include "render/discs.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/thing_clouds.h"

namespace skyig::render {

class DeferredPass {
  public:
    /// \throws std::runtime_error when the program or the textures cannot be made
    DeferredPass();

    /// Once a frame. \param air  of the frame, as the others
    void prepare(const DeferredAir& air, const CloudFrame& clouds, const GroundShadow& shadow, bool dither);
    /// Into the framebuffer that is bound, without blending.
    void draw(const ChannelView& view, const DeferredInput& input,
              const shaders32::ToneParameters& tone) const;

  private:
    struct SourceUniforms {
        int direction, rgb;
    };
    void upload(const DeferredAir& air);
    void upload_veil(const DeferredAir& air);

    gl::Program program_;
    gl::Mesh triangle_;
    ToneUniforms tone_;
    std::array<int, 8> map_;
    std::array<SourceUniforms, 2> sources_;
    int haze_g_, source_count_, even_, dither_, centre_, right_, up_;
    gl::Texture extinction_;
    std::array<gl::Texture, 2> rest_;
    std::array<gl::Texture, 2> haze_;
    struct VeilUniforms {
        int count, radius, slants, molecules, aerosol, above;
        std::array<int, 2> lux, direction, beyond;
    };
    VeilUniforms veil_;
    ThingClouds clouds_;
    gl::Texture veil_segments_;
    std::vector<float> veil_texels_;
    std::uint64_t uploaded_ = 0;
};

}  // namespace skyig::render
