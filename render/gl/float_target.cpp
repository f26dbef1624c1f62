#include "render/gl/float_target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace skyig::render::gl {

FloatTarget::FloatTarget(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA32F, width_px, height_px);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
    throw std::runtime_error("the driver refuses a float target of " + std::to_string(width_px) + "x" +
                             std::to_string(height_px) + " pixels");
}

FloatTarget::~FloatTarget() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
}

void FloatTarget::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, width_px_, height_px_);
}

void FloatTarget::read_row(std::span<glm::vec4> pixels) const {
    const int count = std::min(static_cast<int>(pixels.size()), width_px_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glReadPixels(0, 0, count, 1, GL_RGBA, GL_FLOAT, pixels.data());
}

}  // namespace skyig::render::gl
