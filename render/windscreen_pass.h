// Drops on channels' windscreens, over their finished pictures.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "render/channel.h"
#include "render/gl/coarse_copy.h"
#include "render/gl/framebuffer.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/precipitation/windscreen.h"
#include "render/scene.h"

namespace skyig::render {

/// Costs a copy of the picture with its coarser levels, and the pixels that drops cover; nothing while there
/// are none.
class WindscreenPass {
  public:
    explicit WindscreenPass(std::size_t channels);

    /// Once a frame: every pane to the scene's time.
    void prepare(const Scene& scene);
    /// Into the framebuffer that is bound, which is `picture`'s, blended by coverage. A mirrored picture has
    /// its drops mirrored. Nothing without a windscreen. \throws std::runtime_error when the program cannot
    /// be made, the first time
    void draw(std::size_t channel, const ChannelView& view, const gl::Framebuffer& picture);

  private:
    struct Pane {
        precipitation::Windscreen drops;
        std::optional<gl::CoarseCopy> behind;
        int width_px = 0;
        int height_px = 0;
    };
    struct Shader {
        Shader();
        gl::Program program{"precipitation/windscreen.vert", "precipitation/windscreen.frag"};
        gl::Mesh squares;
        int size, focal;
    };
    std::size_t lay_out(const Pane& pane, const ChannelView& view);

    std::optional<Shader> shader_;
    std::vector<Pane> panes_;
    std::vector<float> vertices_;
};

}  // namespace skyig::render
