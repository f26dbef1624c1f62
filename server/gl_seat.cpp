#include "server/gl_seat.h"

namespace skyig::server {

GlSeat::GlSeat(const GlSeatSettings& settings) {
    // A debug context costs nothing that can be measured here, and every GL error is then counted.
    if (settings.windows.empty()) {
        headless_ = render::gl::HeadlessContext::create(true);
    } else {
        desktop_ = std::make_unique<render::output::Desktop>(settings.windows, settings.vsync);
    }
    renderer_ = std::make_unique<render::Renderer>(settings.channels, settings.display, settings.quality,
                                                   settings.target);
    for (std::size_t i = 0; i < settings.channels.size(); ++i) {
        const render::Channel& channel = settings.channels[i];
        shown_.push_back({renderer_->texture(i), channel.width_px, channel.height_px});
    }
}

bool GlSeat::present() {
    if (!desktop_) return true;
    // A channel's picture may have been made since.
    for (std::size_t i = 0; i < shown_.size(); ++i)
        shown_[i].texture = renderer_->texture(i);
    return desktop_->present(shown_);
}

std::string GlSeat::description() const {
    return desktop_ ? desktop_->description() : headless_->description();
}

}  // namespace skyig::server
