// The settings' windows in the words of who opens them.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "render/output/desktop.h"

namespace skyig::server {

/// None where the settings want no windows. \param node  those of this machine of the rig; empty: all
[[nodiscard]] std::vector<render::output::WindowLayout> window_layouts(const config::Config& config,
                                                                       const std::string& node = {});

}  // namespace skyig::server
