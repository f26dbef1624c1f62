// The picture of one channel: RGBA, 8 bits, read back on demand.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace skyig::render::gl {

class Framebuffer {
  public:
    /// Black and opaque until something is drawn.
    /// \throws std::runtime_error if the driver refuses the size
    Framebuffer(int width_px, int height_px);
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;

    /// Draws go here from now on, to a viewport that is larger than the picture by `guard_px` on each side.
    void bind(int guard_px = 0) const;

    /// Width * height * 4 bytes, top row first. Waits for the pixels.
    void read_rgba8(std::span<std::byte> top_down);

    [[nodiscard]] int width_px() const noexcept { return width_px_; }
    [[nodiscard]] int height_px() const noexcept { return height_px_; }

  private:
    unsigned framebuffer_ = 0;
    unsigned texture_ = 0;
    int width_px_ = 0;
    int height_px_ = 0;
    std::vector<std::byte> row_;
};

}  // namespace skyig::render::gl
