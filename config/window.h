// Where pictures are shown: windows on the desktop, and the part of one that a channel fills.
#pragma once

#include <string>

namespace skyig::config {

inline constexpr int kMaxWindows = 16;
inline constexpr int kMaxDesktop_px = 65535;

/// A [[window]].
struct Window {
    /// 1..32 of letters, digits, '-' and '_', unique.
    std::string name;
    /// Covers the monitor of this name ("HDMI-1") or number ("0"); empty: lies on the desktop as below.
    std::string monitor;
    /// Of the upper left corner of its contents on the desktop.
    int x_px = 0;
    int y_px = 0;
    int width_px = 1280;
    int height_px = 1024;
    /// With a border and a title.
    bool frame = true;
};

/// [channel.viewport]: the part of a window that shows the channel.
struct Viewport {
    /// Index of Config::windows.
    int window = 0;
    /// Of the upper left corner in the window, from its upper left corner.
    int x_px = 0;
    int y_px = 0;
    /// 0: as large as the channel. Pictures of another size are scaled.
    int width_px = 0;
    int height_px = 0;
};

}  // namespace skyig::config
