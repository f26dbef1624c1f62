// The few pieces of pipeline state that the passes need.
#pragma once

namespace skyig::render::gl {

enum class Blend {
    kReplace,
    kAdd,       ///< colour is added to what is there
    kOver,      ///< what is there times alpha, and colour added
    kCoverage,  ///< alpha is the covered part of the pixel
};

/// State that all passes share: no depth, no culling, points sized by the shader.
void set_common_state();
void set_blend(Blend blend);
/// How many of gl_ClipDistance clip, at most 3; none in the common state.
void set_clip_distances(int count);

/// Shaders that follow see in the bound framebuffer's texture what has been drawn so far. One may write the
/// texel that it has read itself, if no other does (OpenGL 4.5, 9.3.1).
void see_what_is_drawn();

/// Blocks until all commands so far are executed.
void finish();

}  // namespace skyig::render::gl
