// Texts over the pictures as configured: [overlay] for all channels, [channel.overlay] for one.
#pragma once

namespace skyig::config {

inline constexpr int kMaxTextScale = 8;

struct Overlay {
    /// What is told, each a line of its own: the mode and the world's time; frames a second; who is obeyed
    /// and how its link stands.
    bool mode = false;
    bool rate = false;
    bool host = false;
    /// In large in the middle, while the host that was obeyed is lost.
    bool host_lost = false;
    /// Screen pixels to a pixel of the font (5 x 8), 1..kMaxTextScale.
    int scale = 2;

    friend bool operator==(const Overlay&, const Overlay&) = default;
};

}  // namespace skyig::config
