#include "render/gl/draw.h"

#include <epoxy/gl.h>

namespace skyig::render::gl {

void set_common_state() {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
}

void set_blend(Blend blend) {
    if (blend == Blend::kReplace) {
        glDisable(GL_BLEND);
        return;
    }
    glEnable(GL_BLEND);
    if (blend == Blend::kAdd) {
        glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
    } else if (blend == Blend::kOver) {
        glBlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_ONE);
    } else {
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    }
}

void set_clip_distances(int count) {
    for (int i = 0; i < 3; ++i) {
        const auto distance = static_cast<GLenum>(GL_CLIP_DISTANCE0 + i);
        if (i < count)
            glEnable(distance);
        else
            glDisable(distance);
    }
}

void see_what_is_drawn() {
    glTextureBarrier();
}

void finish() {
    glFinish();
}

}  // namespace skyig::render::gl
