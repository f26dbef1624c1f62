// A copy of a picture that can be asked at coarser levels.
#pragma once

#include "render/gl/framebuffer.h"

namespace skyig::render::gl {

class CoarseCopy {
  public:
    /// Of 8-bit pictures of that size.
    CoarseCopy(int width_px, int height_px);
    ~CoarseCopy();
    CoarseCopy(CoarseCopy&& other) noexcept;
    CoarseCopy& operator=(CoarseCopy&& other) noexcept;
    CoarseCopy(const CoarseCopy&) = delete;
    CoarseCopy& operator=(const CoarseCopy&) = delete;

    /// What has been drawn so far of a picture of the copy's size, and its levels, each the mean of the one
    /// before.
    void take(const Framebuffer& picture) const;
    /// GL's name for it.
    [[nodiscard]] unsigned name() const noexcept { return name_; }

  private:
    unsigned name_ = 0;
};

}  // namespace skyig::render::gl
