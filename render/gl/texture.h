// Textures of four (or one) floats a texel, rewritten as a whole.
#pragma once

#include <span>

namespace skyig::render::gl {

enum class TexelFormat { kRgba32F, kR32F };

/// Two-dimensional with a depth of 0, else three-dimensional. Linear between texel centres, the edge holds
/// beyond.
class Texture {
  public:
    /// \throws std::runtime_error if the driver cannot hold that size
    /// \param levels  1, or more for a two-dimensional one that is to be asked at coarser levels too, each
    /// half the size of the one before
    Texture(TexelFormat format, int width, int height, int depth = 0, int levels = 1);
    ~Texture();
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    /// All texels: columns, then rows from the lowest, then layers. Fewer than that change nothing.
    void update(std::span<const float> texels) const;
    /// A rectangle of a two-dimensional one without coarser levels, its lowest row first.
    void update_part(int column, int row, int width, int height, std::span<const float> texels) const;
    /// One texel's value in all of it, or in a rectangle.
    void fill(std::span<const float> texel) const;
    void fill_part(int column, int row, int width, int height, std::span<const float> texel) const;

    /// GL's name for it.
    [[nodiscard]] unsigned name() const noexcept { return name_; }

  private:
    TexelFormat format_;
    int width_, height_, depth_, levels_;
    unsigned name_ = 0;
};

/// For the draws that follow. \param texture  GL name, of this library or another's
void bind_texture(int unit, unsigned texture);

}  // namespace skyig::render::gl
