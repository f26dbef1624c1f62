#include "render/gl/picture_copy.h"

#include <epoxy/gl.h>

namespace skyig::render::gl {

PictureCopy::PictureCopy() {
    glCreateFramebuffers(1, &source_);
}

PictureCopy::~PictureCopy() {
    glDeleteFramebuffers(1, &source_);
}

void PictureCopy::onto_window(unsigned texture, int width_px, int height_px,
                              const PixelRectangle& to) const noexcept {
    glNamedFramebufferTexture(source_, GL_COLOR_ATTACHMENT0, texture, 0);
    const bool same = to.width_px == width_px && to.height_px == height_px;
    glBlitNamedFramebuffer(source_, 0, 0, 0, width_px, height_px, to.x_px, to.y_px, to.x_px + to.width_px,
                           to.y_px + to.height_px, GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
}

}  // namespace skyig::render::gl
