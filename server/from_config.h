// The site's settings in the words of those that work with them.
#pragma once

#include <vector>

#include "config/config.h"
#include "render/channel.h"
#include "render/display.h"
#include "server/clock.h"
#include "server/ephemeris/time.h"

namespace skyig::server {

/// The instant that a configured start means: that one, or the system's where the settings say "now".
[[nodiscard]] ephemeris::UtcClockTime start_time(const config::Start& start, const Clock& clock);

[[nodiscard]] std::vector<render::Channel> render_channels(const config::Config& config);

[[nodiscard]] render::DisplaySettings display_settings(const config::Config& config);

}  // namespace skyig::server
