#include "render/gl/framebuffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace skyig::render::gl {

namespace {

GLenum internal_format(PixelFormat format) {
    switch (format) {
        case PixelFormat::kRgba16F:
            return GL_RGBA16F;
        case PixelFormat::kRgba32F:
            return GL_RGBA32F;
        case PixelFormat::kRgba8:
            break;
    }
    return GL_RGBA8;
}

}  // namespace

// After the first constructor the object lives: what is made here is deleted where the driver refuses it.
Framebuffer::Framebuffer(int width_px, int height_px, PixelFormat format) : Framebuffer() {
    width_px_ = width_px;
    height_px_ = height_px;
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width_px < 1 || height_px < 1 || width_px > limit || height_px > limit) {
        throw std::runtime_error("a channel of " + std::to_string(width_px) + "x" +
                                 std::to_string(height_px) + " pixels is outside 1.." +
                                 std::to_string(limit));
    }
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, internal_format(format), width_px, height_px);
    glTextureParameteri(texture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw std::runtime_error("the driver refuses a framebuffer of " + std::to_string(width_px) + "x" +
                                 std::to_string(height_px) + " pixels");
    }
    // A new texture holds whatever was in its memory, and a channel may be read before it is drawn.
    constexpr std::array<GLfloat, 4> kBlack{0.0F, 0.0F, 0.0F, 1.0F};
    glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, kBlack.data());
    // The widest row that is read: three floats a pixel.
    row_.resize(static_cast<std::size_t>(width_px) * 3 * sizeof(float));
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

void Framebuffer::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, width_px_, height_px_);
}

void Framebuffer::copy_into(Framebuffer& picture, int repeat_across, int repeat_upright, bool mirror_across,
                            bool mirror_upright) const {
    const int right_px = width_px_ * repeat_across;
    const int top_px = height_px_ * repeat_upright;
    const int x0 = mirror_across ? picture.width_px_ : 0;
    const int y0 = mirror_upright ? picture.height_px_ : 0;
    glBlitNamedFramebuffer(framebuffer_, picture.framebuffer_, 0, 0, width_px_, height_px_, x0, y0,
                           mirror_across ? x0 - right_px : right_px, mirror_upright ? y0 - top_px : top_px,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::cross_out() {
    constexpr std::array<GLfloat, 4> kGround{0.25F, 0.0F, 0.0F, 1.0F};
    constexpr std::array<GLfloat, 4> kCross{0.9F, 0.0F, 0.0F, 1.0F};
    glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, kGround.data());
    // Both diagonals in steps, of blocks that overlap.
    constexpr int kSteps = 64;
    constexpr int kBlocks = 24;
    const int wide_px = std::max(1, width_px_ / kBlocks);
    const int tall_px = std::max(1, height_px_ / kBlocks);
    glEnable(GL_SCISSOR_TEST);
    for (int i = 0; i < kSteps; ++i) {
        const int left_px = i * (width_px_ - wide_px) / (kSteps - 1);
        const int low_px = i * (height_px_ - tall_px) / (kSteps - 1);
        for (const int bottom_px : {low_px, height_px_ - tall_px - low_px}) {
            glScissor(left_px, bottom_px, wide_px, tall_px);
            glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, kCross.data());
        }
    }
    glDisable(GL_SCISSOR_TEST);
}

void Framebuffer::read_rgba8(std::span<std::byte> top_down) {
    const std::size_t bytes = static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_) * 4;
    if (top_down.size() < bytes) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glReadPixels(0, 0, width_px_, height_px_, GL_RGBA, GL_UNSIGNED_BYTE, top_down.data());
    turn_over(top_down.first(bytes));
}

void Framebuffer::read_rgb32f(std::span<float> top_down) {
    const std::size_t floats = static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_) * 3;
    if (top_down.size() < floats) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glReadPixels(0, 0, width_px_, height_px_, GL_RGB, GL_FLOAT, top_down.data());
    turn_over(std::as_writable_bytes(top_down.first(floats)));
}

// GL's first row is the lowest.
void Framebuffer::turn_over(std::span<std::byte> rows) {
    const auto count = static_cast<std::size_t>(height_px_);
    const std::size_t stride = rows.size() / count;
    for (std::size_t low = 0, high = count - 1; low < high; ++low, --high) {
        std::memcpy(row_.data(), &rows[low * stride], stride);
        std::memcpy(&rows[low * stride], &rows[high * stride], stride);
        std::memcpy(&rows[high * stride], row_.data(), stride);
    }
}

}  // namespace skyig::render::gl
