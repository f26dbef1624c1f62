#include "render/gl/framebuffer.h"

#include <epoxy/gl.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace skyig::render::gl {

Framebuffer::Framebuffer(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width_px < 1 || height_px < 1 || width_px > limit || height_px > limit) {
        throw std::runtime_error("a channel of " + std::to_string(width_px) + "x" +
                                 std::to_string(height_px) + " pixels is outside 1.." +
                                 std::to_string(limit));
    }
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA8, width_px, height_px);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw std::runtime_error("the driver refuses a framebuffer of " + std::to_string(width_px) + "x" +
                                 std::to_string(height_px) + " pixels");
    }
    // A new texture holds whatever was in its memory, and a channel may be read before it is drawn.
    constexpr std::array<GLfloat, 4> kBlack{0.0F, 0.0F, 0.0F, 1.0F};
    glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, kBlack.data());
    row_.resize(static_cast<std::size_t>(width_px) * 4);
}

Framebuffer::~Framebuffer() {
    if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
    if (texture_ != 0) glDeleteTextures(1, &texture_);
}

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : framebuffer_(std::exchange(other.framebuffer_, 0U)),
      texture_(std::exchange(other.texture_, 0U)),
      width_px_(other.width_px_),
      height_px_(other.height_px_),
      row_(std::move(other.row_)) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(framebuffer_, other.framebuffer_);
    std::swap(texture_, other.texture_);
    std::swap(width_px_, other.width_px_);
    std::swap(height_px_, other.height_px_);
    std::swap(row_, other.row_);
    return *this;
}

void Framebuffer::bind(int guard_px) const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    glViewport(-guard_px, -guard_px, width_px_ + 2 * guard_px, height_px_ + 2 * guard_px);
}

void Framebuffer::read_rgba8(std::span<std::byte> top_down) {
    const std::size_t stride = row_.size();
    const auto rows = static_cast<std::size_t>(height_px_);
    if (top_down.size() < stride * rows) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glReadPixels(0, 0, width_px_, height_px_, GL_RGBA, GL_UNSIGNED_BYTE, top_down.data());
    for (std::size_t low = 0, high = rows - 1; low < high; ++low, --high) {
        std::memcpy(row_.data(), &top_down[low * stride], stride);
        std::memcpy(&top_down[low * stride], &top_down[high * stride], stride);
        std::memcpy(&top_down[high * stride], row_.data(), stride);
    }
}

}  // namespace skyig::render::gl
