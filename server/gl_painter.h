// The Painter of the programs: the renderer on an OpenGL context, without a window or behind some.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "render/gl/headless_context.h"
#include "render/output/desktop.h"
#include "render/renderer.h"
#include "server/painter.h"

namespace skyig::server {

class GlPainter final : public Painter {
  public:
    /// Its context belongs to the thread that makes it.
    /// \throws std::runtime_error with one line when there is no display, no OpenGL 4.5 or no memory for the
    /// channels
    GlPainter(std::vector<render::Channel> channels, const render::DisplaySettings& display,
              const render::Quality& quality, render::Target target = render::Target::kDisplay);
    /// The same behind a desktop's windows.
    GlPainter(std::unique_ptr<render::output::Desktop> desktop, std::vector<render::Channel> channels,
              const render::DisplaySettings& display, const render::Quality& quality);

    /// Clouds can be drawn from the next frame on. Called at the first scene that has some if it was not
    /// before: who must not be held up then for a quarter of a second calls it at the start.
    void draw_clouds();
    void thin(render::Thinned thinned) override { renderer_.thin(thinned); }
    [[nodiscard]] render::Thinned thinnable() const override { return thinnable_; }
    void prepare(const render::Scene& scene) override;
    void draw(std::size_t channel) override;
    bool present() override;
    void read_back(std::size_t channel, std::span<std::byte> rgba) override;
    /// Of a target of luminance. \see render::Renderer::read_luminance()
    void read_luminance(std::size_t channel, std::span<float> rgb_cd_m2);
    [[nodiscard]] bool rebuilt() const override { return rebuilt_; }
    [[nodiscard]] bool on_processor() const override;
    [[nodiscard]] std::size_t gl_objects() const override;
    [[nodiscard]] std::uint64_t gl_errors() const override { return gl_errors_; }
    [[nodiscard]] double adaptation_cd_m2() const override { return adaptation_cd_m2_; }
    [[nodiscard]] std::size_t passes(std::span<status::PassState> rows) const override;
    [[nodiscard]] std::string description() const override;

  private:
    // One of the two; the renderer's objects live in it.
    std::unique_ptr<render::gl::HeadlessContext> headless_;
    std::unique_ptr<render::output::Desktop> desktop_;
    render::Renderer renderer_;
    std::vector<render::output::Shown> shown_;
    std::array<render::PlannedPass, render::kPassCount> passes_{};
    render::Thinned thinnable_;
    bool rebuilt_ = false;
    bool draws_clouds_ = false;
    std::uint64_t gl_errors_ = 0;
    double adaptation_cd_m2_ = 0.0;
};

}  // namespace skyig::server
