// The picture of one channel, read back on demand.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace skyig::render::gl {

enum class PixelFormat { kRgba8, kRgba16F, kRgba32F };

class Framebuffer {
  public:
    /// Black and opaque until something is drawn.
    /// \throws std::runtime_error if the driver refuses the size
    Framebuffer(int width_px, int height_px, PixelFormat format = PixelFormat::kRgba8);
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;

    /// Draws go here from now on.
    void bind() const;

    /// Writes this picture into another, each pixel as a block of so many from the lower left corner on (what
    /// reaches beyond is cut off), and that mirrored as asked.
    void copy_into(Framebuffer& picture, int repeat_across, int repeat_upright, bool mirror_across,
                   bool mirror_upright) const;
    /// A red cross on dark red: this picture cannot be drawn. Needs no program.
    void cross_out();

    /// Width * height * 4 bytes, top row first. Waits for the pixels.
    void read_rgba8(std::span<std::byte> top_down);
    /// Width * height * 3 floats, top row first; of an 8-bit picture 0..1. Waits for the pixels.
    void read_rgb32f(std::span<float> top_down);

    /// For who shows the picture elsewhere.
    [[nodiscard]] unsigned texture() const noexcept { return texture_; }
    [[nodiscard]] int width_px() const noexcept { return width_px_; }
    [[nodiscard]] int height_px() const noexcept { return height_px_; }

  private:
    Framebuffer() noexcept = default;
    void turn_over(std::span<std::byte> rows);

    unsigned framebuffer_ = 0;
    unsigned texture_ = 0;
    int width_px_ = 0;
    int height_px_ = 0;
    std::vector<std::byte> row_;
};

}  // namespace skyig::render::gl
