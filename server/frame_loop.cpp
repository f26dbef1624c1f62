#include "server/frame_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "server/endpoint_format.h"
#include "server/from_config.h"

namespace skyig::server {

namespace {

/// Frames that come late are told when they are more than this part of the frames in that time.
constexpr double kToldLatePart = 0.01;
constexpr double kWatchFor_s = 10.0;
constexpr double kRemindAfter_s = 60.0;

}  // namespace

/// Durations from one call to the next.
class FrameLoop::Stopwatch {
  public:
    Stopwatch(const Clock& clock, std::int64_t start_ns) noexcept : clock_(clock), before_ns_(start_ns) {}

    std::int64_t lap_ns() noexcept {
        const std::int64_t now_ns = clock_.monotonic_ns();
        return now_ns - std::exchange(before_ns_, now_ns);
    }

  private:
    const Clock& clock_;
    std::int64_t before_ns_;
};

FrameLoop::FrameLoop(const config::Config& config, const FrameLoopParts& parts, std::uint64_t frame_limit,
                     std::uint64_t image_every, ephemeris::EarthOrientation orientation)
    : config_(config),
      parts_(parts),
      frame_limit_(frame_limit),
      image_every_(image_every),
      answers_(config.host),
      inbox_(config, parts.world, parts.log),
      scenes_(ephemeris_model(config), std::move(orientation), sky_settings(config.sky),
              ground_settings(config.ground), night_settings(config.night),
              weather::weather_settings(config.weather)),
      overlay_(config),
      times_(config.channels.size()),
      lock_step_(config.daemon),
      delays_(config.channels.size()),
      on_processor_(parts.painter.on_processor()) {
    if (!config.overload.order.empty() && !parts.pace.replays())
        overload_.emplace(config.overload, parts.pace.period_s());
    parts.world.look_ahead(config.daemon.display_delay_s());
}

void FrameLoop::warm_up() {
    render::Scene scene = scenes_.build(parts_.world, 0);
    parts_.painter.settle(scene);
    parts_.painter.prepare(scene);
    for (std::size_t channel = 0; channel < config_.channels.size(); ++channel)
        parts_.painter.draw(channel);
    tell_date();
}

void FrameLoop::run(const std::function<bool()>& stop) {
    while (!stop() && (frame_limit_ == 0 || frame_number_ < frame_limit_))
        if (!run_frame()) return;
}

bool FrameLoop::run_frame() {
    const std::optional<FramePacer::Slot> next = parts_.pace.next();
    if (!next) return false;
    const FramePacer::Slot slot = *next;
    const std::int64_t start_ns = parts_.clock.monotonic_ns();
    if (first_start_ns_ == 0) first_start_ns_ = start_ns;
    const std::int64_t utc_ns = parts_.clock.steady_utc_ns();
    frame_number_ = slot.told_number != 0 ? slot.told_number : frame_number_ + 1;

    thin(slot);
    answer_host(slot, utc_ns);
    const std::uint64_t arrivals_before = inbox_.arrivals();
    status::FrameParts times;
    times.start_ns = start_ns;
    const std::int64_t processor_before_ns = parts_.clock.processor_ns();
    Stopwatch stopwatch(parts_.clock, start_ns);
    take_input(slot, times, stopwatch);
    render::Scene scene = scenes_.build(parts_.world, frame_number_);
    overlay_.write(parts_.world, slot.slots, scene);
    parts_.painter.settle(scene);
    times.input_ns += stopwatch.lap_ns();
    times_.input().add(times.input_ns);
    draw(scene, stopwatch, times);
    const bool wanted = parts_.painter.present();
    if (!wanted) parts_.log.notice("a window was closed: the daemon ends");
    tell_monitors();
    times.display_ns = stopwatch.lap_ns();
    const std::int64_t shown_ns = parts_.painter.showed() ? start_ns + times.duration_ns() : 0;
    if (parts_.wire.live()) delays_.shown(parts_.clock.steady_utc_ns(), inbox_.frame_arrivals());
    hand_out(scene);
    times.output_ns = stopwatch.lap_ns();
    if (on_processor_) times.processor_ns = parts_.clock.processor_ns() - processor_before_ns;
    last_end_ns_ = start_ns + times.duration_ns();
    times_.frame().add(times.duration_ns());
    if (parts_.table != nullptr) {
        parts_.table->add(
            {frame_number_, utc_ns, slot.slots, slot.late, inbox_.arrivals() - arrivals_before, shown_ns},
            times_);
    }
    close_frame(slot, times);
    if (parts_.status != nullptr) publish_status(scene);
    if (parts_.service != nullptr) parts_.service->frame_drawn(last_end_ns_);
    return wanted;
}

void FrameLoop::note_settings(bool taken) noexcept {
    ++(taken ? settings_.times_taken : settings_.times_refused);
    if (taken) settings_.last_taken_utc_ns = parts_.clock.utc_ns();
}

void FrameLoop::thin(const FramePacer::Slot& slot) {
    const bool own = overload_ && slot.told_number == 0;
    const render::Thinned wanted = own ? overload_->thinned() : render::Thinned(slot.thinned);
    if (wanted != thinned_) parts_.painter.thin(wanted);
    thinned_ = wanted;
}

void FrameLoop::take_input(const FramePacer::Slot& slot, status::FrameParts& times, Stopwatch& stopwatch) {
    inbox_.begin_frame();
    parts_.wire.drain(inbox_);
    times.input_ns = stopwatch.lap_ns();
    lock_step_.await(parts_.clock, parts_.wire, inbox_, parts_.world);
    times.host_ns = stopwatch.lap_ns();
    parts_.world.advance(static_cast<double>(slot.slots) * parts_.pace.period_s());
}

void FrameLoop::hand_out(const render::Scene& scene) {
    if (!parts_.painter.showed()) return;
    const bool written = frame_number_ % image_every_ == 0;
    // Who draws scenes itself sees all of a replay, so that files do not depend on how many are wanted.
    const bool seen = parts_.images != nullptr && parts_.images->takes_scenes() && parts_.pace.replays();
    if (parts_.images != nullptr && (written || seen)) hand_out_images(scene, written);
    if (parts_.hashes != nullptr) hash_images();
    if (parts_.preview == nullptr) return;
    parts_.preview->offer(
        parts_.clock.monotonic_ns(),
        [this](std::size_t channel, std::span<std::byte> rgba) { parts_.painter.read_back(channel, rgba); });
}

void FrameLoop::close_frame(const FramePacer::Slot& slot, const status::FrameParts& times) {
    record_.add(times, slot.late, parts_.pace.period_s());
    if (overload_) {
        const double passed_s = static_cast<double>(slot.slots) * parts_.pace.period_s();
        tell_thinning(overload_->add(static_cast<double>(times.work_ns()) * 1e-9, passed_s,
                                     parts_.painter.thinnable()));
    }
    watch(slot);
}

void FrameLoop::answer_host(const FramePacer::Slot& slot, std::int64_t utc_ns) {
    const std::span<const std::byte> message = answers_.open_frame(parts_.world, slot.start_ns, slot.late);
    parts_.wire.open_frame({frame_number_, slot.slots, thinned_.to_ullong(), utc_ns}, message);
    const auto destination = answers_.destination(parts_.world.control_source(), parts_.world.control_link());
    if (!destination) return;
    if (parts_.wire.send(parts_.world.control_source(), *destination, message)) {
        ++start_of_frame_sent_;
        return;
    }
    ++start_of_frame_failed_;
    parts_.log.limited("answer not sent", kRemindAfter_s, Severity::kWarning,
                       "Start of Frame to {} not sent: the system did not take it", *destination);
}

void FrameLoop::draw(const render::Scene& scene, Stopwatch& stopwatch, status::FrameParts& times) {
    const bool live = parts_.wire.live();
    std::int64_t first_utc_ns = 0;
    std::int64_t last_utc_ns = 0;
    parts_.painter.prepare(scene);
    times.rebuilt = parts_.painter.rebuilt();
    tell_resets();
    times.shared_ns = stopwatch.lap_ns();
    times_.shared().add(times.shared_ns);
    for (std::size_t channel = 0; channel < config_.channels.size(); ++channel) {
        parts_.painter.draw(channel);
        const std::int64_t took_ns = stopwatch.lap_ns();
        times_.channel(channel).add(took_ns);
        times.channels_ns += took_ns;
        // What is crossed out shows no message.
        if (!live || !parts_.painter.draws(channel) || parts_.painter.health(channel).failed) continue;
        last_utc_ns = parts_.clock.steady_utc_ns();
        if (first_utc_ns == 0) first_utc_ns = last_utc_ns;
        delays_.finished(channel, last_utc_ns, inbox_.frame_arrivals());
    }
    if (last_utc_ns != 0) tell_host_of_pictures(first_utc_ns, last_utc_ns);
    tell_channels();
}

/// For whoever measures delays from the other end.
void FrameLoop::tell_host_of_pictures(std::int64_t first_utc_ns, std::int64_t last_utc_ns) {
    const auto microseconds = [](std::int64_t duration_ns) {
        return static_cast<std::uint32_t>(std::clamp<std::int64_t>(duration_ns / 1000, 0, UINT32_MAX));
    };
    for (const Arrivals::HostMessage& message : inbox_.frame_arrivals().host()) {
        // What is lost is told by its absence.
        (void)parts_.world.outbox().events.raise(world::Event::kFrameFinished, message.frame_number,
                                                 microseconds(last_utc_ns - message.arrival_ns),
                                                 microseconds(first_utc_ns - message.arrival_ns));
    }
}

void FrameLoop::tell_channels() {
    for (std::size_t channel = 0; channel < config_.channels.size(); ++channel) {
        const status::ChannelHealth health = parts_.painter.health(channel);
        if (health.failed == told_failed_[channel]) continue;
        told_failed_[channel] = health.failed;
        const std::string& name = config_.channels[channel].name;
        if (health.failed) {
            parts_.log.limited({"channel failed", channel}, kRemindAfter_s, Severity::kWarning,
                               "channel {} cannot be drawn: {}; {}", name, health.reason(),
                               health.crossed_out ? "it is crossed out in red and tried again"
                                                  : "nothing is shown of it until then");
        } else {
            parts_.log.limited({"channel drawn", channel}, kRemindAfter_s, Severity::kNotice,
                               "channel {} is drawn again, after {} failures since the start", name,
                               health.failures);
        }
    }
}

void FrameLoop::tell_monitors() {
    for (std::size_t channel = 0; channel < config_.channels.size(); ++channel) {
        const bool hidden = parts_.painter.hides(channel);
        if (hidden == told_hidden_[channel]) continue;
        told_hidden_[channel] = hidden;
        const std::string& name = config_.channels[channel].name;
        if (hidden) {
            parts_.log.limited({"monitor gone", channel}, kRemindAfter_s, Severity::kWarning,
                               "channel {} is not shown: its monitor is gone; its window waits for that",
                               name);
        } else {
            parts_.log.limited({"monitor back", channel}, kRemindAfter_s, Severity::kNotice,
                               "channel {} is shown again: its monitor is back", name);
        }
    }
}

void FrameLoop::tell_resets() {
    if (parts_.painter.resets() == told_resets_) return;
    told_resets_ = parts_.painter.resets();
    parts_.log.warning("the graphics device was reset: everything is made anew on it");
}

void FrameLoop::hash_images() {
    for (std::size_t i = 0; i < config_.channels.size(); ++i) {
        if (!parts_.painter.draws(i)) continue;
        const config::Channel& channel = config_.channels[i];
        read_back_.resize(static_cast<std::size_t>(channel.width_px) *
                          static_cast<std::size_t>(channel.height_px) * 4U);
        parts_.painter.read_back(i, read_back_);
        parts_.hashes->add(frame_number_, channel.name, read_back_);
    }
}

void FrameLoop::hand_out_images(const render::Scene& scene, bool written) {
    ImageWriter::Frame* images =
        parts_.pace.replays() ? parts_.images->acquire() : parts_.images->try_acquire();
    if (images == nullptr) return;
    images->written = written;
    images->number = frame_number_;
    if (parts_.images->takes_scenes()) images->scene = scene;
    for (std::size_t channel = 0; channel < images->channels.size(); ++channel)
        if (parts_.painter.draws(channel)) parts_.painter.read_back(channel, images->channels[channel]);
    parts_.images->submit(images);
}

/// What goes wrong over many frames is told once a while, never once a frame.
void FrameLoop::watch(const FramePacer::Slot& slot) {
    if (slot.slots > 1) slots_left_out_ += slot.slots - 1;
    ++watched_.frames;
    if (slot.late) {
        ++late_frames_;
        ++watched_.late;
    }
    watched_.slots += slot.slots;
    tell_spacing();
    if (static_cast<double>(watched_.slots) * parts_.pace.period_s() < kWatchFor_s) return;
    tell_late_frames();
    tell_dropped_datagrams();
    tell_what_is_drawn_otherwise();
    gl_objects_ = parts_.painter.gl_objects();
    watched_ = {};
}

void FrameLoop::tell_thinning(Overload::Step step) {
    if (step == Overload::Step::kNone) return;
    const Overload::State& state = overload_->state();
    const std::string_view what = config::thinning_name(static_cast<config::Thinning>(state.last_thing));
    if (step == Overload::Step::kThinned) {
        parts_.log.limited("thinned", kRemindAfter_s, Severity::kNotice,
                           "leaves out {}: a frame takes {:.1f} of {:.1f} ms", what,
                           state.last_load * parts_.pace.period_s() * 1e3, parts_.pace.period_s() * 1e3);
    } else {
        parts_.log.limited("returned", kRemindAfter_s, Severity::kNotice,
                           "{} is back: a frame takes {:.1f} of {:.1f} ms", what,
                           state.last_load * parts_.pace.period_s() * 1e3, parts_.pace.period_s() * 1e3);
    }
}

void FrameLoop::tell_spacing() {
    const std::uint64_t spaced = parts_.pace.spaced();
    // Single ones are a driver's; a second of them is a display that nobody waits for.
    if (static_cast<double>(spaced - told_spaced_) < config_.daemon.rate_hz) return;
    told_spaced_ = spaced;
    parts_.log.limited("spaced", kRemindAfter_s, Severity::kNotice,
                       "the windows' swap does not wait for a display: the clock spaces frames at {:g} Hz "
                       "({} frames since the start)",
                       config_.daemon.rate_hz, spaced);
}

void FrameLoop::tell_late_frames() {
    if (static_cast<double>(watched_.late) <= kToldLatePart * static_cast<double>(watched_.frames)) return;
    parts_.log.limited(
        "late frames", kRemindAfter_s, Severity::kWarning,
        "{} of the last {} frames were late: {:g} Hz leaves {:.1f} ms, a frame has taken {:.1f} ms (median), "
        "{:.1f} ms (p95) since the start",
        watched_.late, watched_.frames, config_.daemon.rate_hz, parts_.pace.period_s() * 1e3,
        times_.frame().quantile_ms(0.5), times_.frame().quantile_ms(0.95));
}

void FrameLoop::tell_what_is_drawn_otherwise() {
    tell_date();
    if (scenes_.weather_left_out() > 0) {
        parts_.log.limited(
            "weather left out", kRemindAfter_s, Severity::kWarning,
            "{} layers of weather are not drawn: there is room for the nearest {} clouds and {} "
            "veils",
            scenes_.weather_left_out(), render::Weather::kMaxClouds, render::Weather::kMaxObscurants);
    }
    if (scenes_.eye_spread_m() > config::kMaxEyeSpread_m) {
        parts_.log.limited(
            "eye spread", kRemindAfter_s, Severity::kWarning,
            "the host has moved a view's eye {:.0f} m from the mean of all, from which all are drawn; "
            "beyond {:g} m use a daemon of its own",
            scenes_.eye_spread_m(), config::kMaxEyeSpread_m);
    }
}

/// Once each time that the world's date goes there.
void FrameLoop::tell_date() {
    if (scenes_.date_clamped() && !told_clamped_)
        parts_.log.warning("the world's date is outside 1900..2100: the sky of the nearest end is drawn");
    told_clamped_ = scenes_.date_clamped();
    if (scenes_.leap_seconds_assumed() && !told_leap_seconds_) {
        parts_.log.info(
            "the world's date is beyond the announced leap seconds: TT - UTC is held at its last value");
    }
    told_leap_seconds_ = scenes_.leap_seconds_assumed();
}

void FrameLoop::tell_dropped_datagrams() {
    const protocol::transport::UdpCounters now = parts_.wire.counters();
    if (now.not_allowed > told_wire_.not_allowed) {
        parts_.log.limited("sender not allowed", kRemindAfter_s, Severity::kWarning,
                           "{} datagrams dropped: their senders are not in allow",
                           now.not_allowed - told_wire_.not_allowed);
    }
    const std::uint64_t too_many =
        now.ring_full + now.queue_full - told_wire_.ring_full - told_wire_.queue_full;
    if (too_many > 0) {
        parts_.log.limited("too many datagrams", kRemindAfter_s, Severity::kWarning,
                           "{} datagrams dropped: they came faster than they can be taken", too_many);
    }
    told_wire_ = now;
}

}  // namespace skyig::server
