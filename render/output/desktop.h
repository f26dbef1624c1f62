// Windows on the desktop that show finished channels (GLFW), and the OpenGL context that draws them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace skyig::render::output {

/// The part of a window that a channel fills.
struct Part {
    std::size_t channel = 0;
    /// From the window's upper left corner.
    int x_px = 0;
    int y_px = 0;
    int width_px = 0;
    int height_px = 0;
};

struct WindowLayout {
    std::string title;
    /// Covers the monitor of this name, or of this number when the window is made; empty: lies on the
    /// desktop.
    std::string monitor;
    int x_px = 0;
    int y_px = 0;
    int width_px = 1280;
    int height_px = 1024;
    bool frame = true;
    std::vector<Part> parts;
};

/// A picture to be shown: a texture of the desktop's context, whose pixels are finished.
struct Shown {
    unsigned texture = 0;
    int width_px = 0;
    int height_px = 0;
};

/// Belongs to the main thread. Its own context, which draws, outlives every window: it is current whenever no
/// member function runs. One at a time.
class Desktop {
  public:
    /// \param vsync  the first window's pictures change between two refreshes; else whenever they are ready
    /// \throws std::runtime_error with one line when there is no display, no OpenGL 4.5 or no such monitor
    Desktop(std::vector<WindowLayout> windows, bool vsync);
    ~Desktop();
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;

    /// Shows each channel's picture in every part that is its own, one texel a pixel or scaled, and takes the
    /// desktop's events. A window whose monitor is gone is hidden until it is back. \param channels  by
    /// number; what lies beyond shows nothing. Allocates nothing of its own. \return false once a person has
    /// closed a window
    bool present(std::span<const Shown> channels);

    /// Whether a window that shows the channel waits for its monitor to come back.
    [[nodiscard]] bool hides(std::size_t channel) const noexcept;

    /// As HeadlessContext::description().
    [[nodiscard]] std::string description() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace skyig::render::output
