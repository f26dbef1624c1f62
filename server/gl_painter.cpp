#include "server/gl_painter.h"

#include <algorithm>
#include <utility>

#include "render/clouds.h"
#include "render/gl/objects.h"

namespace skyig::server {

// A debug context costs nothing that can be measured here, and every GL error is then counted.
GlPainter::GlPainter(std::vector<render::Channel> channels, const render::DisplaySettings& display,
                     const render::Quality& quality, render::Target target)
    : headless_(std::make_unique<render::gl::HeadlessContext>(render::gl::HeadlessContext::create(true))),
      renderer_(std::move(channels), display, quality, target) {}

GlPainter::GlPainter(std::unique_ptr<render::output::Desktop> desktop, std::vector<render::Channel> channels,
                     const render::DisplaySettings& display, const render::Quality& quality)
    : desktop_(std::move(desktop)), renderer_(std::move(channels), display, quality) {
    for (std::size_t i = 0; i < renderer_.channels().size(); ++i) {
        const render::Channel& channel = renderer_.channels()[i];
        shown_.push_back({renderer_.texture(i), channel.width_px, channel.height_px});
    }
}

void GlPainter::draw_clouds() {
    if (draws_clouds_) return;
    renderer_.draw_clouds(render::scene_clouds());
    draws_clouds_ = true;
}

void GlPainter::prepare(const render::Scene& scene) {
    if (scene.weather.cloud_count > 0) draw_clouds();
    const render::FrameReport& report = renderer_.prepare(scene);
    passes_ = report.plan.passes;
    thinnable_ = render::thinnable(report.plan);
    rebuilt_ = report.plan.needs(render::Pass::kAirTables) || report.plan.needs(render::Pass::kSunSky) ||
               report.plan.needs(render::Pass::kMoonSky);
    gl_errors_ = report.gl_errors;
    adaptation_cd_m2_ = report.adaptation_cd_m2;
}

void GlPainter::draw(std::size_t channel) {
    renderer_.draw(channel);
}

bool GlPainter::present() {
    return !desktop_ || desktop_->present(shown_);
}

void GlPainter::read_back(std::size_t channel, std::span<std::byte> rgba) {
    renderer_.read_back(channel, rgba);
}

void GlPainter::read_luminance(std::size_t channel, std::span<float> rgb_cd_m2) {
    renderer_.read_luminance(channel, rgb_cd_m2);
}

std::string GlPainter::description() const {
    return desktop_ ? desktop_->description() : headless_->description();
}

// Mesa names both of its software rasterisers.
bool GlPainter::on_processor() const {
    const std::string text = description();
    return text.find("llvmpipe") != std::string::npos || text.find("softpipe") != std::string::npos;
}

std::size_t GlPainter::gl_objects() const {
    return render::gl::count_objects();
}

std::size_t GlPainter::passes(std::span<status::PassState> rows) const {
    const std::size_t count = std::min(rows.size(), passes_.size());
    for (std::size_t i = 0; i < count; ++i)
        rows[i] = {render::pass_name(passes_[i].pass), passes_[i].needed, passes_[i].reason};
    return count;
}

}  // namespace skyig::server
