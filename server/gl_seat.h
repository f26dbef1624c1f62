// What lives and dies with an OpenGL context: the context, the windows before it, the renderer in it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/headless_context.h"
#include "render/gl/reset_watch.h"
#include "render/output/desktop.h"
#include "render/renderer.h"

namespace skyig::server {

/// All that it takes to make a seat, and to make it again.
struct GlSeatSettings {
    std::vector<render::Channel> channels;
    render::DisplaySettings display{};
    render::Quality quality{};
    render::Target target = render::Target::kDisplay;
    /// Behind these windows; none: no window system is asked for.
    std::vector<render::output::WindowLayout> windows{};
    bool vsync = true;
};

class GlSeat {
  public:
    /// Its context belongs to the thread that makes it. One with windows at a time.
    /// \throws std::runtime_error with one line when there is no display, no OpenGL 4.5 or no memory for the
    /// channels
    explicit GlSeat(const GlSeatSettings& settings);

    /// \return false once nobody wants to see the channels any more
    bool present();

    /// Whether the channel's window waits for its monitor.
    [[nodiscard]] bool hides(std::size_t channel) const noexcept {
        return desktop_ && desktop_->hides(channel);
    }

    [[nodiscard]] render::Renderer& renderer() noexcept { return *renderer_; }
    [[nodiscard]] render::gl::ResetWatch& resets() noexcept { return resets_; }
    [[nodiscard]] std::string description() const;

  private:
    // One of the two; the renderer's objects live in it.
    std::optional<render::gl::HeadlessContext> headless_;
    std::unique_ptr<render::output::Desktop> desktop_;
    std::unique_ptr<render::Renderer> renderer_;
    std::vector<render::output::Shown> shown_;
    render::gl::ResetWatch resets_;
};

}  // namespace skyig::server
