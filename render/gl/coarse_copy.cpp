#include "render/gl/coarse_copy.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace skyig::render::gl {

CoarseCopy::CoarseCopy(int width_px, int height_px) {
    const auto longest = static_cast<unsigned>(std::max(width_px, height_px));
    glCreateTextures(GL_TEXTURE_2D, 1, &name_);
    glTextureStorage2D(name_, static_cast<GLsizei>(std::bit_width(longest)), GL_RGBA8, width_px, height_px);
    glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

CoarseCopy::~CoarseCopy() {
    if (name_ != 0) glDeleteTextures(1, &name_);
}

CoarseCopy::CoarseCopy(CoarseCopy&& other) noexcept : name_(std::exchange(other.name_, 0U)) {}

CoarseCopy& CoarseCopy::operator=(CoarseCopy&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

void CoarseCopy::take(const Framebuffer& picture) const {
    glCopyImageSubData(picture.texture(), GL_TEXTURE_2D, 0, 0, 0, 0, name_, GL_TEXTURE_2D, 0, 0, 0, 0,
                       picture.width_px(), picture.height_px(), 1);
    glGenerateTextureMipmap(name_);
}

}  // namespace skyig::render::gl
