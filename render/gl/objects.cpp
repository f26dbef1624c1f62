#include "render/gl/objects.h"

#include <epoxy/gl.h>

namespace skyig::render::gl {

std::size_t count_objects() {
    constexpr GLuint kLastName = 1024;
    std::size_t count = 0;
    for (GLuint name = 1; name <= kLastName; ++name) {
        count += glIsTexture(name) == GL_TRUE ? 1U : 0U;
        count += glIsBuffer(name) == GL_TRUE ? 1U : 0U;
        count += glIsVertexArray(name) == GL_TRUE ? 1U : 0U;
        count += glIsFramebuffer(name) == GL_TRUE ? 1U : 0U;
        count += glIsProgram(name) == GL_TRUE ? 1U : 0U;
    }
    return count;
}

}  // namespace skyig::render::gl
