// The Painter of the programs: the renderer on an OpenGL context, without a window or behind some. It
// outlives the device's resets: context, windows and renderer are made anew from the settings and the scene.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/channel_guard.h"
#include "server/gl_seat.h"
#include "server/painter.h"

namespace skyig::server {

class GlPainter final : public Painter {
  public:
    /// \throws std::runtime_error as GlSeat
    explicit GlPainter(GlSeatSettings settings);

    /// Clouds can be drawn from the next frame on. Called at the first scene that has some if it was not
    /// before: who must not be held up then for a quarter of a second calls it at the start.
    void draw_clouds();
    /// The same of patterns, texts and resampling, now and after each reset.
    void make_ready();
    /// What frames may be off by from the next one on, which takes as long as a start: all is made anew.
    void take_quality(const render::Quality& quality) noexcept;
    /// Called before a frame in which all is made anew, for new quality or after a reset.
    void before_anew(std::function<void()> told) { before_anew_ = std::move(told); }
    void thin(render::Thinned thinned) override { thinned_ = thinned; }
    [[nodiscard]] render::Thinned thinnable() const override { return thinnable_; }
    /// The first call may throw; later it does not: what cannot be had of the device is as its loss. After a
    /// reset it takes as long as a start; while the device cannot be had it is asked for every
    /// kRetryFrames; the channels keep what they show and have failed.
    void prepare(const render::Scene& scene) override;
    [[nodiscard]] render::eye::Adaptation eyes() const override;
    void adapt_as(const render::eye::Adaptation& eyes) override;
    void draw(std::size_t channel) override;
    bool present() override;
    /// Black while there is no device.
    void read_back(std::size_t channel, std::span<std::byte> rgba) override;
    /// Of a target of luminance. \see render::Renderer::read_luminance()
    void read_luminance(std::size_t channel, std::span<float> rgb_cd_m2);
    [[nodiscard]] bool hides(std::size_t channel) const override { return seat_ && seat_->hides(channel); }
    [[nodiscard]] bool rebuilt() const override { return rebuilt_; }
    [[nodiscard]] bool on_processor() const override;
    [[nodiscard]] std::size_t gl_objects() const override;
    [[nodiscard]] std::uint64_t gl_errors() const override { return errors_before_ + errors_; }
    [[nodiscard]] std::uint64_t resets() const override { return resets_; }
    [[nodiscard]] double adaptation_cd_m2() const override { return adaptation_cd_m2_; }
    [[nodiscard]] std::size_t passes(std::span<status::PassState> rows) const override;
    [[nodiscard]] std::string description() const override { return description_; }

    [[nodiscard]] status::ChannelHealth health(std::size_t channel) const override {
        return guards_[channel].health();
    }

    /// As if the device had been reset before the next frame.
    void inject_reset() noexcept;
    /// OpenGL will report an error in the channel's next `count` draws.
    void inject_errors(std::size_t channel, int count) noexcept { errors_to_make_[channel] = count; }

    static constexpr int kRetryFrames = 60;

  private:
    void sit_down();
    void prepare_seat(const render::Scene& scene);
    void leave_lost_device() noexcept;
    void try_to_draw(std::size_t channel);

    GlSeatSettings settings_;
    std::function<void()> before_anew_;
    std::unique_ptr<GlSeat> seat_;  // none while the device cannot be had
    std::string description_;
    std::array<render::PlannedPass, render::kPassCount> passes_{};
    render::Thinned thinned_;
    render::Thinned thinnable_;
    bool rebuilt_ = false;
    /// What eyes were adapted to when the device was lost.
    std::optional<render::eye::Adaptation> eyes_;
    int frames_to_retry_ = 0;
    std::vector<ChannelGuard> guards_;
    std::vector<int> errors_to_make_;
    bool clouds_wanted_ = false;
    bool ready_wanted_ = false;
    bool draws_clouds_ = false;
    bool has_prepared_ = false;
    std::uint64_t errors_ = 0;
    std::uint64_t errors_before_ = 0;
    std::uint64_t resets_ = 0;
    double adaptation_cd_m2_ = 0.0;
};

}  // namespace skyig::server
