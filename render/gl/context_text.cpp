#include "render/gl/context_text.h"

#include <epoxy/gl.h>

namespace skyig::render::gl {

std::string context_text() {
    const auto text = [](GLenum name) {
        const auto* value = reinterpret_cast<const char*>(glGetString(name));
        return std::string(value != nullptr ? value : "?");
    };
    return text(GL_VERSION) + ", " + text(GL_RENDERER);
}

}  // namespace skyig::render::gl
