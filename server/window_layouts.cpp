#include "server/window_layouts.h"

namespace skyig::server {

std::vector<render::output::WindowLayout> window_layouts(const config::Config& config,
                                                         const std::string& node) {
    std::vector<render::output::WindowLayout> layouts;
    if (config.output.kind != config::OutputKind::kWindow) return layouts;
    for (const config::Window& window : config.windows) {
        layouts.push_back({"skyig " + window.name,
                           window.monitor,
                           window.x_px,
                           window.y_px,
                           window.width_px,
                           window.height_px,
                           window.frame,
                           {}});
    }
    for (std::size_t i = 0; i < config.channels.size(); ++i) {
        const config::Channel& channel = config.channels[i];
        if (!channel.viewport || (!node.empty() && channel.node != node)) continue;
        const config::Viewport& view = *channel.viewport;
        layouts[static_cast<std::size_t>(view.window)].parts.push_back(
            {i, view.x_px, view.y_px, view.width_px > 0 ? view.width_px : channel.width_px,
             view.height_px > 0 ? view.height_px : channel.height_px});
    }
    // Another machine's.
    if (!node.empty()) std::erase_if(layouts, [](const auto& layout) { return layout.parts.empty(); });
    return layouts;
}

}  // namespace skyig::server
