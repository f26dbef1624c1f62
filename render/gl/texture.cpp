#include "render/gl/texture.h"

#include <epoxy/gl.h>
#include <array>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace skyig::render::gl {

namespace {

std::size_t components(TexelFormat format) {
    return format == TexelFormat::kRgba32F ? 4 : 1;
}

}  // namespace

Texture::Texture(TexelFormat format, int width, int height, int depth, int levels)
    : format_(format), width_(width), height_(height), depth_(depth), levels_(levels) {
    GLint limit = 0;
    glGetIntegerv(depth > 0 ? GL_MAX_3D_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || depth < 0 || width > limit || height > limit || depth > limit) {
        throw std::runtime_error("a texture of " + std::to_string(width) + "x" + std::to_string(height) +
                                 "x" + std::to_string(depth) + " texels is outside 1.." +
                                 std::to_string(limit));
    }
    const GLenum internal = format == TexelFormat::kRgba32F ? GL_RGBA32F : GL_R32F;
    glCreateTextures(depth > 0 ? GL_TEXTURE_3D : GL_TEXTURE_2D, 1, &name_);
    if (depth > 0) {
        glTextureStorage3D(name_, levels, internal, width, height, depth);
    } else {
        glTextureStorage2D(name_, levels, internal, width, height);
    }
    glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum side : std::array<GLenum, 3>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name_, side, GL_CLAMP_TO_EDGE);
}

Texture::~Texture() {
    if (name_ != 0) glDeleteTextures(1, &name_);
}

Texture::Texture(Texture&& other) noexcept
    : format_(other.format_),
      width_(other.width_),
      height_(other.height_),
      depth_(other.depth_),
      levels_(other.levels_),
      name_(std::exchange(other.name_, 0U)) {}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(format_, other.format_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(depth_, other.depth_);
    std::swap(levels_, other.levels_);
    std::swap(name_, other.name_);
    return *this;
}

void Texture::update(std::span<const float> texels) const {
    const std::size_t layers = depth_ > 0 ? static_cast<std::size_t>(depth_) : 1;
    if (texels.size() <
        layers * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * components(format_))
        return;
    const GLenum layout = format_ == TexelFormat::kRgba32F ? GL_RGBA : GL_RED;
    if (depth_ > 0) {
        glTextureSubImage3D(name_, 0, 0, 0, 0, width_, height_, depth_, layout, GL_FLOAT, texels.data());
    } else {
        glTextureSubImage2D(name_, 0, 0, 0, width_, height_, layout, GL_FLOAT, texels.data());
    }
    if (levels_ > 1) glGenerateTextureMipmap(name_);
}

void Texture::update_part(int column, int row, int width, int height, std::span<const float> texels) const {
    if (texels.size() <
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * components(format_))
        return;
    const GLenum layout = format_ == TexelFormat::kRgba32F ? GL_RGBA : GL_RED;
    glTextureSubImage2D(name_, 0, column, row, width, height, layout, GL_FLOAT, texels.data());
}

void Texture::fill(std::span<const float> texel) const {
    fill_part(0, 0, width_, height_, texel);
}

void Texture::fill_part(int column, int row, int width, int height, std::span<const float> texel) const {
    if (texel.size() < components(format_)) return;
    const GLenum layout = format_ == TexelFormat::kRgba32F ? GL_RGBA : GL_RED;
    glClearTexSubImage(name_, 0, column, row, 0, width, height, 1, layout, GL_FLOAT, texel.data());
}

void bind_texture(int unit, unsigned texture) {
    glBindTextureUnit(static_cast<GLuint>(unit), texture);
}

}  // namespace skyig::render::gl
