// The screens of a rig: channels with equal ones share what is toned for them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/channel.h"

namespace skyig::render {

struct Screens {
    /// Each different one, in the order of the channels.
    std::vector<Screen> distinct;
    /// For each channel, its place in `distinct`.
    std::vector<std::size_t> of_channel;
};

/// \param usual  of channels that have none of their own
[[nodiscard]] inline Screens screens_of(std::span<const Channel> channels, const Screen& usual) {
    Screens screens;
    for (const Channel& channel : channels) {
        const Screen& screen = channel.screen ? *channel.screen : usual;
        std::size_t at = 0;
        while (at < screens.distinct.size() && screens.distinct[at] != screen)
            ++at;
        if (at == screens.distinct.size()) screens.distinct.push_back(screen);
        screens.of_channel.push_back(at);
    }
    return screens;
}

}  // namespace skyig::render
