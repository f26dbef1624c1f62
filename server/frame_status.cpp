// What the frame loop tells of itself: snapshots while it runs, the report of a run.
#include <fmt/format.h>

#include <algorithm>

#include "server/frame_loop.h"
#include "server/from_config.h"
#include "server/status/from_snapshot.h"

namespace skyig::server {

namespace {

/// Often enough for a watching eye; a flood of questions costs the frame loop no more than one.
constexpr std::int64_t kPublishEvery_ns = 100'000'000;

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

status::Times times_of(const TimeHistogram& times) noexcept {
    return {times.quantile_ms(0.5), times.quantile_ms(0.95), times.largest_ms()};
}

status::Delay delay_of(const TimeHistogram& times) noexcept {
    return {times.count(), times.quantile_ms(0.5), times.quantile_ms(0.99), times.largest_ms()};
}

std::string_view pace_name(config::Pacing pacing) noexcept {
    switch (pacing) {
        case config::Pacing::kDisplay:
            return "display";
        case config::Pacing::kHost:
            return "host";
        case config::Pacing::kClock:
            break;
    }
    return "clock";
}

}  // namespace

status::Facts FrameLoop::facts() const {
    status::Facts facts;
    facts.version = SKYIG_VERSION;
    facts.renderer = parts_.painter.description();
    facts.rate_hz = config_.daemon.rate_hz;
    facts.pace = pace_name(config_.daemon.pacing);
    for (const config::Thinning thinning : config_.overload.order)
        facts.thinning_order.emplace_back(config::thinning_name(thinning));
    for (const config::Channel& channel : config_.channels) {
        facts.channels.push_back(channel.name);
        if (config_.rig) facts.channel_nodes.push_back(channel.node);
    }
    for (const world::SourceRule& rule : world::source_rules(config_))
        facts.sources.push_back({rule.name, rule.kind, {}});
    facts.elevation_m = config_.weather.elevation_m;
    facts.transition_s = config_.weather.transition_s;
    facts.ephemeris = ephemeris::name_of(ephemeris_model(config_));
    facts.earth_orientation = days_text(scenes_.orientation());
    return facts;
}

RunReport FrameLoop::report() const {
    status::Snapshot snapshot;
    take_stock(snapshot);
    snapshot.gl_objects = parts_.painter.gl_objects();
    return status::make_report(facts(), snapshot);
}

void FrameLoop::publish_status(const render::Scene& scene) {
    if (frame_number_ > 1 && last_end_ns_ - published_ns_ < kPublishEvery_ns) return;
    published_ns_ = last_end_ns_;
    status::Snapshot& snapshot = parts_.status->draft();
    take_stock(snapshot);
    const SkyAngles angles = sky_angles(scene);
    snapshot.world.sun_elevation_deg = angles.sun_elevation_deg;
    snapshot.world.sun_azimuth_deg = angles.sun_azimuth_deg;
    snapshot.world.moon_elevation_deg = angles.moon_elevation_deg;
    snapshot.world.moon_azimuth_deg = angles.moon_azimuth_deg;
    snapshot.world.moon_lit_fraction = angles.moon_lit_fraction;
    parts_.status->publish();
}

void FrameLoop::take_stock(status::Snapshot& snapshot) const {
    snapshot.frames = frame_number_;
    snapshot.elapsed_s = static_cast<double>(last_end_ns_ - first_start_ns_) * 1e-9;
    snapshot.late_frames = late_frames_;
    snapshot.slots_left_out = slots_left_out_;
    snapshot.frames_spaced = parts_.pace.spaced();
    snapshot.record = record_;
    snapshot.input = times_of(times_.input());
    snapshot.shared = times_of(times_.shared());
    snapshot.frame = times_of(times_.frame());
    for (std::size_t i = 0; i < config_.channels.size(); ++i)
        snapshot.channels[i] = times_of(times_.channel(i));
    for (std::size_t i = 0; i < config_.channels.size(); ++i)
        snapshot.health[i] = parts_.painter.health(i);
    for (std::size_t i = 0; i < config_.channels.size(); ++i)
        snapshot.hidden[i] = parts_.painter.hides(i);
    snapshot.pass_count = parts_.painter.passes(snapshot.passes);
    snapshot.start_of_frame_sent = start_of_frame_sent_;
    snapshot.start_of_frame_failed = start_of_frame_failed_;
    snapshot.gl_errors = parts_.painter.gl_errors();
    snapshot.gl_resets = parts_.painter.resets();
    snapshot.settings = settings_;
    parts_.painter.rig(snapshot.rig);
    if (parts_.images != nullptr) {
        const ImageWriter::Counts images = parts_.images->counts();
        snapshot.images_written = images.written;
        snapshot.images_failed = images.failed;
        snapshot.image_frames_skipped = images.skipped;
    }
    take_stock_of_pacing(snapshot);
    take_stock_of_world(snapshot);
    take_stock_of_sources(snapshot);
}

void FrameLoop::take_stock_of_pacing(status::Snapshot& snapshot) const {
    for (std::size_t i = 0; i < config_.channels.size(); ++i)
        snapshot.delays[i] = delay_of(delays_.channel(i));
    snapshot.delay_shown = delay_of(delays_.shown());
    snapshot.host_interval = delay_of(inbox_.host_timing().interval());
    snapshot.host_jitter = delay_of(inbox_.host_timing().jitter());
    snapshot.host_timeouts = lock_step_.timeouts();
    snapshot.gl_objects = gl_objects_;
    snapshot.thinning = {};
    snapshot.thinning.thinned = thinned_.to_ullong();
    if (!overload_) return;
    const Overload::State& state = overload_->state();
    snapshot.thinning.times_thinned = state.times_thinned;
    snapshot.thinning.times_returned = state.times_returned;
    snapshot.thinning.exhausted = state.exhausted;
    snapshot.thinning.any_step = state.last_step != Overload::Step::kNone;
    snapshot.thinning.last_thinned = state.last_step == Overload::Step::kThinned;
    snapshot.thinning.last_thing = static_cast<std::size_t>(state.last_thing);
    snapshot.thinning.last_load = state.last_load;
}

void FrameLoop::take_stock_of_world(status::Snapshot& snapshot) const {
    const world::World& world = parts_.world;
    snapshot.world.mode = world.mode();
    snapshot.world.utc = world.clock().utc();
    snapshot.world.clock_running = world.clock().running();
    snapshot.world.scene_time_s = world.time_s();
    snapshot.world.ownship = world.ownship();
    snapshot.world.air = world.air();
    const auto layers = world.weather().layers_of(protocol::cigi::WeatherScope::kGlobal, 0);
    snapshot.world.layer_count = std::min(layers.size(), status::kMostLayers);
    snapshot.world.layers_left_out = layers.size() - snapshot.world.layer_count;
    std::copy_n(layers.begin(), snapshot.world.layer_count, snapshot.world.layers.begin());
    snapshot.world.adaptation_cd_m2 = parts_.painter.adaptation_cd_m2();
    snapshot.date_clamped = scenes_.date_clamped();
    snapshot.leap_seconds_assumed = scenes_.leap_seconds_assumed();
}

void FrameLoop::take_stock_of_sources(status::Snapshot& snapshot) const {
    const world::World& world = parts_.world;
    const world::Authority& authority = world.authority();
    for (std::size_t aspect = 0; aspect < config::kAspectCount; ++aspect) {
        const auto which = static_cast<config::Aspect>(aspect);
        snapshot.aspects[aspect] = {authority.holder(which), authority.hold_reason(which)};
        for (std::size_t source = 0; source < authority.size(); ++source)
            snapshot.sources[source].overruled[aspect] = authority.overruled(source, which);
    }
    for (std::size_t source = 0; source < authority.size(); ++source) {
        snapshot.sources[source].link = world.link(source);
        snapshot.sources[source].rights = authority.rule(source).rights;
        snapshot.sources[source].arrivals = inbox_.arrivals(source);
        if (const BusInput* bus = inbox_.bus(source))
            snapshot.canaerospace[source] = bus->receiver().counters();
        if (const FlightGearInput* model = inbox_.flight_model(source)) {
            status::FlightGearCounts& counts = snapshot.flightgear[source];
            counts.packets = model->packets();
            for (std::size_t i = 0; i < counts.refused.size(); ++i)
                counts.refused[i] = model->refused(static_cast<protocol::flightgear::Reason>(i));
        }
    }
    snapshot.control_source = world.control_source();
    snapshot.host_version = world.session().version();
    snapshot.host_order = world.session().host_order();
    snapshot.frames_behind_median = inbox_.frames_behind().quantile(0.5);
    snapshot.frames_behind_largest = inbox_.frames_behind().largest();
    snapshot.datagrams = inbox_.datagrams();
    snapshot.cigi = inbox_.counters();
    snapshot.refused = world.counters();
    snapshot.udp = parts_.wire.counters();
}

}  // namespace skyig::server
