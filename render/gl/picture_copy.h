// A finished picture onto the window whose context is current.
#pragma once

namespace skyig::render::gl {

/// Pixels from the lower left corner.
struct PixelRectangle {
    int x_px = 0;
    int y_px = 0;
    int width_px = 0;
    int height_px = 0;
};

/// Belongs to the context that is current when it is made, and when it goes: what it holds is not shared.
class PictureCopy {
  public:
    PictureCopy();
    ~PictureCopy();
    PictureCopy(const PictureCopy&) = delete;
    PictureCopy& operator=(const PictureCopy&) = delete;

    /// Code for code where the sizes agree, else scaled (bilinear). \param texture  a GL name, which contexts
    /// share
    void onto_window(unsigned texture, int width_px, int height_px, const PixelRectangle& to) const noexcept;

  private:
    unsigned source_ = 0;
};

}  // namespace skyig::render::gl
