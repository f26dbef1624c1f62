// Lays a channel's blend over its finished picture.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "render/channel.h"
#include "render/gl/framebuffer.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"

namespace skyig::render {

class BlendPass {
  public:
    /// Of the channels that have a blend which changes anything. \throws std::runtime_error when a program or
    /// a texture cannot be made
    BlendPass(std::span<const Channel> channels, bool dither);

    /// In place, in the framebuffer that is bound and whole in its viewport. \param encode_power  of the
    /// codes it holds, as ToneParameters has it, >= 0
    void draw(std::size_t channel, const gl::Framebuffer& picture, float encode_power) const;

  private:
    struct Shader {
        Shader();
        gl::Program program{"warp/blend.vert", "warp/blend.frag"};
        int encode_power, dither;
    };
    struct Mask {
        gl::Texture weight;
        gl::Texture lift;
        gl::Mesh tiles;
        std::size_t index_count;
    };

    std::optional<Shader> shader_;
    std::vector<std::optional<Mask>> masks_;  // by channel
};

}  // namespace skyig::render
