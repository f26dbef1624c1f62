// skyig channels: what the channels of a site cover, and how they meet.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Returns the exit status: 0, or 2 when the settings are wrong.
[[nodiscard]] int run_channels(const ChannelsOptions& options);

}  // namespace skyig::clients
