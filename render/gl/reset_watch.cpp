#include "render/gl/reset_watch.h"

#include <epoxy/gl.h>

namespace skyig::render::gl {

bool ResetWatch::lost() noexcept {
    lost_ = lost_ || glGetGraphicsResetStatus() != GL_NO_ERROR;
    return lost_;
}

}  // namespace skyig::render::gl
