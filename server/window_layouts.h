// The settings' windows in the words of who opens them.
#pragma once

#include <vector>

#include "config/config.h"
#include "render/output/desktop.h"

namespace skyig::server {

/// None where the settings want no windows.
[[nodiscard]] std::vector<render::output::WindowLayout> window_layouts(const config::Config& config);

}  // namespace skyig::server
