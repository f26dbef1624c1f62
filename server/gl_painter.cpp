#include "server/gl_painter.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "render/clouds.h"
#include "render/gl/debug_log.h"
#include "render/gl/objects.h"

namespace skyig::server {

GlPainter::GlPainter(GlSeatSettings settings)
    : settings_(std::move(settings)),
      guards_(settings_.channels.size()),
      errors_to_make_(settings_.channels.size()) {
    sit_down();
}

void GlPainter::sit_down() {
    seat_ = std::make_unique<GlSeat>(settings_);
    description_ = seat_->description();
    draws_clouds_ = false;
    for (ChannelGuard& guard : guards_)
        guard.begin_anew();
    if (eyes_) seat_->renderer().adapt_as(*eyes_);
    if (ready_wanted_) seat_->renderer().make_ready();
}

void GlPainter::leave_lost_device() noexcept {
    eyes_ = seat_->renderer().adaptation();
    // They were there all along, however long it takes.
    eyes_->resume();
    errors_before_ += std::exchange(errors_, 0);
    seat_.reset();
    ++resets_;
    frames_to_retry_ = 0;
}

void GlPainter::take_quality(const render::Quality& quality) noexcept {
    settings_.quality = quality;
    if (!seat_) return;
    leave_lost_device();
    --resets_;
}

void GlPainter::draw_clouds() {
    clouds_wanted_ = true;
    if (draws_clouds_ || !seat_) return;
    seat_->renderer().draw_clouds(render::scene_clouds());
    draws_clouds_ = true;
}

void GlPainter::make_ready() {
    ready_wanted_ = true;
    if (seat_) seat_->renderer().make_ready();
}

void GlPainter::prepare(const render::Scene& scene) {
    if (seat_ && seat_->resets().lost()) leave_lost_device();
    if (!has_prepared_) {
        prepare_seat(scene);
        has_prepared_ = true;
        return;
    }
    if (!seat_ && frames_to_retry_-- > 0) return;
    try {
        if (!seat_) {
            if (before_anew_) before_anew_();
            sit_down();
        }
        prepare_seat(scene);
    } catch (const std::exception&) {
        // No memory, or the device is not back yet.
        if (seat_) leave_lost_device();
        frames_to_retry_ = kRetryFrames;
    }
}

void GlPainter::prepare_seat(const render::Scene& scene) {
    if (clouds_wanted_ || scene.weather.cloud_count > 0) draw_clouds();
    seat_->renderer().thin(thinned_);
    const render::FrameReport& report = seat_->renderer().prepare(scene);
    passes_ = report.plan.passes;
    thinnable_ = render::thinnable(report.plan);
    rebuilt_ = report.plan.needs(render::Pass::kAirTables) || report.plan.needs(render::Pass::kSunSky) ||
               report.plan.needs(render::Pass::kMoonSky);
    errors_ = report.gl_errors;
    adaptation_cd_m2_ = report.adaptation_cd_m2;
}

render::eye::Adaptation GlPainter::eyes() const {
    if (seat_) return seat_->renderer().adaptation();
    return eyes_.value_or(render::eye::Adaptation{});
}

void GlPainter::adapt_as(const render::eye::Adaptation& eyes) {
    if (seat_)
        seat_->renderer().adapt_as(eyes);
    else
        eyes_ = eyes;
}

void GlPainter::draw(std::size_t channel) {
    if (!seat_ && !guards_[channel].health().failed)
        guards_[channel].failed("the graphics device is not back after a reset", false);
    if (!seat_ || !guards_[channel].try_now()) return;
    try {
        try_to_draw(channel);
    } catch (const std::exception& error) {
        guards_[channel].failed(error.what(), true);
    }
    if (guards_[channel].health().failed) seat_->renderer().cross_out(channel);
}

void GlPainter::try_to_draw(std::size_t channel) {
    render::Renderer& renderer = seat_->renderer();
    const std::uint64_t errors_before = renderer.gl_errors();
    if (errors_to_make_[channel] > 0) {
        --errors_to_make_[channel];
        render::gl::inject_error();
    }
    renderer.draw(channel);
    if (renderer.gl_errors() == errors_before)
        guards_[channel].drawn();
    else
        guards_[channel].failed("OpenGL reported an error", true);
}

bool GlPainter::present() {
    return !seat_ || seat_->present();
}

void GlPainter::read_back(std::size_t channel, std::span<std::byte> rgba) {
    if (seat_) {
        seat_->renderer().read_back(channel, rgba);
    } else {
        std::fill(rgba.begin(), rgba.end(), std::byte{0});
    }
}

void GlPainter::read_luminance(std::size_t channel, std::span<float> rgb_cd_m2) {
    if (seat_) {
        seat_->renderer().read_luminance(channel, rgb_cd_m2);
    } else {
        std::fill(rgb_cd_m2.begin(), rgb_cd_m2.end(), 0.0F);
    }
}

void GlPainter::inject_reset() noexcept {
    if (seat_) seat_->resets().inject();
}

// Mesa names both of its software rasterisers.
bool GlPainter::on_processor() const {
    const std::string text = description();
    return text.find("llvmpipe") != std::string::npos || text.find("softpipe") != std::string::npos;
}

std::size_t GlPainter::gl_objects() const {
    return seat_ ? render::gl::count_objects() : 0;
}

std::size_t GlPainter::passes(std::span<status::PassState> rows) const {
    const std::size_t count = std::min(rows.size(), passes_.size());
    for (std::size_t i = 0; i < count; ++i)
        rows[i] = {render::pass_name(passes_[i].pass), passes_[i].needed, passes_[i].reason};
    return count;
}

}  // namespace skyig::server
