#include "server/frame_loop.h"

#include <fmt/format.h>

#include <utility>

#include "server/endpoint_format.h"
#include "server/from_config.h"

namespace skyig::server {

namespace cigi = protocol::cigi;

namespace {

/// Frames that come late are told when they are more than this part of the frames in that time.
constexpr double kToldLatePart = 0.01;
constexpr double kWatchFor_s = 10.0;
constexpr double kRepeatAfter_s = 60.0;

std::string protocol_text(const cigi::Session& session) {
    return fmt::format("{} {}-endian", session.version() == cigi::Version::k40 ? "4.0" : "3.3",
                       session.host_order() == cigi::ByteOrder::kBig ? "big" : "little");
}

std::string day_text(double mjd) {
    constexpr double kUnixEpochMjd = 40587.0;
    constexpr double kSecondsPerDay = 86400.0;
    const auto since_1970_s = static_cast<std::int64_t>((mjd - kUnixEpochMjd) * kSecondsPerDay);
    return ephemeris::to_iso(ephemeris::UtcClockTime::from_unix(since_1970_s)).substr(0, 10);
}

std::string days_text(const ephemeris::EarthOrientation& orientation) {
    if (orientation.empty()) return {};
    return fmt::format("{}..{}", day_text(orientation.first_mjd()), day_text(orientation.last_mjd()));
}

}  // namespace

FrameLoop::FrameLoop(const config::Config& config, const FrameLoopParts& parts, std::uint64_t frame_limit,
                     std::uint64_t image_every, ephemeris::EarthOrientation orientation)
    : config_(config),
      parts_(parts),
      frame_limit_(frame_limit),
      image_every_(image_every),
      answers_(config.host),
      inbox_(config, parts.world, parts.log),
      scenes_(ephemeris_model(config), std::move(orientation), sky_settings(config.sky)),
      times_(config.channels.size()) {}

void FrameLoop::warm_up() {
    parts_.painter.prepare(scenes_.build(parts_.world, 0));
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
    if (frame_number_ == 0) first_start_ns_ = start_ns;
    ++frame_number_;

    answer_host(slot);
    parts_.wire.drain(inbox_);
    parts_.world.advance(static_cast<double>(slot.slots) * parts_.pace.period_s());
    draw(scenes_.build(parts_.world, frame_number_));
    if (parts_.images != nullptr && frame_number_ % image_every_ == 0) hand_out_images();
    if (parts_.hashes != nullptr) hash_images();

    last_end_ns_ = parts_.clock.monotonic_ns();
    times_.frame().add(last_end_ns_ - start_ns);
    watch(slot);
    return true;
}

void FrameLoop::answer_host(const FramePacer::Slot& slot) {
    const std::span<const std::byte> message = answers_.open_frame(parts_.world, slot.start_ns, slot.late);
    parts_.wire.open_frame({frame_number_, slot.slots, parts_.clock.utc_ns()}, message);
    const auto destination = answers_.destination(parts_.world.control_source(), parts_.world.control_link());
    if (!destination) return;
    if (parts_.wire.send(parts_.world.control_source(), *destination, message)) {
        ++start_of_frame_sent_;
        return;
    }
    ++start_of_frame_failed_;
    parts_.log.limited("answer not sent", kRepeatAfter_s, Severity::kWarning,
                       "Start of Frame to {} not sent: the system did not take it", *destination);
}

void FrameLoop::draw(const render::Scene& scene) {
    std::int64_t before_ns = parts_.clock.monotonic_ns();
    const auto lap = [this, &before_ns](TimeHistogram& times) {
        const std::int64_t now_ns = parts_.clock.monotonic_ns();
        times.add(now_ns - before_ns);
        before_ns = now_ns;
    };
    parts_.painter.prepare(scene);
    lap(times_.shared());
    for (std::size_t channel = 0; channel < config_.channels.size(); ++channel) {
        parts_.painter.draw(channel);
        lap(times_.channel(channel));
    }
}

void FrameLoop::hash_images() {
    for (std::size_t i = 0; i < config_.channels.size(); ++i) {
        const config::Channel& channel = config_.channels[i];
        read_back_.resize(static_cast<std::size_t>(channel.width_px) *
                          static_cast<std::size_t>(channel.height_px) * 4U);
        parts_.painter.read_back(i, read_back_);
        parts_.hashes->add(frame_number_, channel.name, read_back_);
    }
}

void FrameLoop::hand_out_images() {
    ImageWriter::Frame* images = parts_.images->try_acquire();
    if (images == nullptr) return;
    images->number = frame_number_;
    for (std::size_t channel = 0; channel < images->channels.size(); ++channel)
        parts_.painter.read_back(channel, images->channels[channel]);
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
    if (static_cast<double>(watched_.slots) * parts_.pace.period_s() < kWatchFor_s) return;
    tell_late_frames();
    tell_dropped_datagrams();
    tell_what_is_drawn_otherwise();
    watched_ = {};
}

void FrameLoop::tell_late_frames() {
    if (static_cast<double>(watched_.late) <= kToldLatePart * static_cast<double>(watched_.frames)) return;
    parts_.log.limited(
        "late frames", kRepeatAfter_s, Severity::kWarning,
        "{} of the last {} frames were late: {:g} Hz leaves {:.1f} ms, a frame has taken {:.1f} ms (median), "
        "{:.1f} ms (p95) since the start",
        watched_.late, watched_.frames, config_.daemon.rate_hz, parts_.pace.period_s() * 1e3,
        times_.frame().quantile_ms(0.5), times_.frame().quantile_ms(0.95));
}

void FrameLoop::tell_what_is_drawn_otherwise() {
    tell_date();
    if (scenes_.eye_spread_m() > config::kMaxEyeSpread_m) {
        parts_.log.limited(
            "eye spread", kRepeatAfter_s, Severity::kWarning,
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
        parts_.log.limited("sender not allowed", kRepeatAfter_s, Severity::kWarning,
                           "{} datagrams dropped: their senders are not in allow",
                           now.not_allowed - told_wire_.not_allowed);
    }
    if (now.ring_full > told_wire_.ring_full) {
        parts_.log.limited("ring full", kRepeatAfter_s, Severity::kWarning,
                           "{} datagrams dropped: they came faster than frames take them",
                           now.ring_full - told_wire_.ring_full);
    }
    told_wire_ = now;
}

RunReport FrameLoop::report() const {
    RunReport report;
    report.version = SKYIG_VERSION;
    report.renderer = parts_.painter.description();
    report.gl_errors = parts_.painter.gl_errors();
    report.rate_hz = config_.daemon.rate_hz;
    report.elapsed_s = static_cast<double>(last_end_ns_ - first_start_ns_) * 1e-9;
    report.frames = frame_number_;
    report.late_frames = late_frames_;
    report.slots_left_out = slots_left_out_;
    report.times.push_back(time_row("shared", times_.shared()));
    for (std::size_t i = 0; i < config_.channels.size(); ++i)
        report.times.push_back(time_row(config_.channels[i].name, times_.channel(i)));
    report.times.push_back(time_row("frame", times_.frame()));
    report.start_of_frame_sent = start_of_frame_sent_;
    report.start_of_frame_failed = start_of_frame_failed_;
    report_ephemeris(report);
    report_host(report);
    if (parts_.images != nullptr) {
        const ImageWriter::Counts images = parts_.images->counts();
        report.images_written = images.written;
        report.images_failed = images.failed;
        report.image_frames_skipped = images.skipped;
    }
    return report;
}

void FrameLoop::report_ephemeris(RunReport& report) const {
    report.ephemeris = ephemeris::name_of(ephemeris_model(config_));
    report.earth_orientation = days_text(scenes_.orientation());
    report.date_clamped = scenes_.date_clamped();
    report.leap_seconds_assumed = scenes_.leap_seconds_assumed();
}

void FrameLoop::report_host(RunReport& report) const {
    const world::Link link = parts_.world.control_link();
    if (link.state != world::LinkState::kWaiting) {
        report.host = fmt::to_string(link.host);
        report.host_protocol = protocol_text(parts_.world.session());
    }
    report.host_losses = link.losses;
    report.datagrams = inbox_.datagrams();
    report.host_frames_behind_median = inbox_.frames_behind().quantile(0.5);
    report.host_frames_behind_largest = inbox_.frames_behind().largest();

    const cigi::Counters& counters = inbox_.counters();
    for (std::size_t kind = 0; kind < cigi::kHostPacketKinds; ++kind)
        report.packets.push_back({std::string(cigi::packet_name(kind)), counters.packets[kind]});
    for (std::size_t i = 0; i < cigi::kCounts; ++i)
        report.rejects.push_back(
            {std::string(cigi::count_name(static_cast<cigi::Count>(i))), counters.counts[i]});
    for (const world::NamedCounter& counter : world::kCounterNames)
        report.rejects.push_back({std::string(counter.name), parts_.world.counters().*counter.value});
    const protocol::transport::UdpCounters received = parts_.wire.counters();
    report.rejects.push_back({"not_allowed", received.not_allowed});
    report.rejects.push_back({"ring_full", received.ring_full});
}

}  // namespace skyig::server
