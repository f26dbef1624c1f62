// A picture of four floats a pixel, for what is measured and not shown.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace skyig::render::gl {

class FloatTarget {
  public:
    /// \throws std::runtime_error if the driver refuses the size
    FloatTarget(int width_px, int height_px);
    ~FloatTarget();
    FloatTarget(const FloatTarget&) = delete;
    FloatTarget& operator=(const FloatTarget&) = delete;

    /// Draws go here from now on.
    void bind() const;

    /// The first `pixels.size()` pixels of the lowest row, at most its width. Waits for them.
    void read_row(std::span<glm::vec4> pixels) const;

    [[nodiscard]] int width_px() const noexcept { return width_px_; }

  private:
    unsigned framebuffer_ = 0;
    unsigned texture_ = 0;
    int width_px_ = 0;
    int height_px_ = 0;
};

}  // namespace skyig::render::gl
