#include "server/world/world.h"

#include <cmath>
#include <string_view>
#include <utility>

#include "server/world/conditions.h"
#include "server/world/weather_limits.h"

namespace skyig::server::world {

namespace cigi = protocol::cigi;
using protocol::transport::to_string;

namespace {

cigi::SessionOptions session_options(const config::Host& host) {
    cigi::SessionOptions options;
    options.version = host.cigi.major == 4 ? cigi::Version::k40 : cigi::Version::k33;
    options.database = host.database == config::DatabasePolicy::kAccept ? cigi::DatabasePolicy::kAccept
                                                                        : cigi::DatabasePolicy::kNone;
    return options;
}

Ownship configured_ownship(const config::Start& start) {
    const Pose pose{{start.latitude_deg, start.longitude_deg, start.height_m},
                    start.yaw_deg,
                    start.pitch_deg,
                    start.roll_deg};
    return {pose};
}

CelestialSwitches configured_celestial(const config::Sky& sky) {
    return {sky.sun, sky.moon, sky.stars, sky.star_intensity_pct / 100.0};
}

AirState configured_air(const config::Air& air) {
    AirState state;
    state.visibility_m = air.visibility_m;
    state.visibility_contrast = air.visibility_contrast;
    state.temperature_c = air.temperature_c;
    state.pressure_hpa = air.pressure_hpa;
    state.humidity_pct = air.humidity_pct;
    state.wind_horizontal_m_s = air.wind_m_s;
    state.wind_from_deg = air.wind_from_deg;
    return state;
}

std::string_view version_name(cigi::Version version) {
    return version == cigi::Version::k40 ? "4.0" : "3.3";
}

std::string_view order_name(cigi::ByteOrder order) {
    return order == cigi::ByteOrder::kBig ? "big-endian" : "little-endian";
}

/// Takes over what a sky can have; hosts that care for visibility only leave the others at 0.
bool take(double value, double min, double max, double& out) noexcept {
    if (!(value >= min && value <= max)) return false;
    out = value;
    return true;
}

}  // namespace

World::World(const config::Config& config, const ephemeris::UtcClockTime& start_utc, Log& log)
    : config_(config),
      log_(log),
      authority_(source_rules(config)),
      peers_(authority_.size()),
      session_(session_options(config.host)),
      default_utc_(start_utc),
      clock_(start_utc, config.start.running),
      ownship_(configured_ownship(config.start)),
      celestial_(configured_celestial(config.sky)),
      start_weather_(server::start_weather(config)),
      views_(config.channels) {
    own_.track.reset(ownship_);
    set_start_weather();
}

Link World::link(std::size_t source) const noexcept {
    return {authority_.state(source), peers_[source].endpoint, authority_.silent_s(source),
            authority_.losses(source)};
}

bool World::in_operation() const noexcept {
    return mode() != cigi::IgMode::kStandby || !authority_.owned(config::Aspect::kControl);
}

void World::begin_message(std::size_t source, const protocol::transport::Endpoint& from) noexcept {
    source_ = source;
    from_ = from;
    verdict_ = Verdict::kNoControl;
    stamp_s_.reset();
    // Should this message's IG Control be refused, its other packets count by what was agreed before.
    const LinkState state = authority_.state(source);
    if ((state == LinkState::kLive || state == LinkState::kStale) && from == peers_[source].endpoint)
        verdict_ = in_operation() ? Verdict::kObeyed : Verdict::kStandby;
}

void World::operator()(const cigi::IgControl& packet, const cigi::PacketInfo& info) {
    if (!claim_peer(info)) {
        verdict_ = Verdict::kOtherHost;
        ++counters_.second_host;
        say_second_host();
        return;
    }
    if (packet.timestamp_valid) {
        const double stamp_s = peers_[source_].stamps.seconds(packet.timestamp);
        if (packet.extrapolation_enable) stamp_s_ = stamp_s;
    }
    if (authority_.claim(source_, config::Aspect::kControl)) {
        take_control(packet, info);
    } else {
        verdict_ = in_operation() ? Verdict::kObeyed : Verdict::kStandby;
    }
    if (verdict_ == Verdict::kObeyed) note_smoothing(source_, packet.extrapolation_enable);
}

void World::take_control(const cigi::IgControl& packet, const cigi::PacketInfo& info) {
    // Its frame numbers have nothing to do with those of whoever was in control before.
    if (session_source_ != source_) session_.new_peer();
    if (session_source_.value_or(source_) != source_) outbox_.clear();
    session_source_ = source_;
    const cigi::SessionEvents events = session_.receive(packet, info.version, info.order);
    if (events.host_restarted) outbox_.clear();
    outbox_.messages.open(mode() == cigi::IgMode::kDebug);
    verdict_ = events.obey ? Verdict::kObeyed : events.late ? Verdict::kLate : Verdict::kStandby;
    if (events.entered_standby) reset();
    note_events(events);
}

bool World::claim_peer(const cigi::PacketInfo& info) {
    Peer& peer = peers_[source_];
    const LinkState before = authority_.state(source_);
    const bool spoken_for = before == LinkState::kLive || before == LinkState::kStale;
    if (spoken_for && from_ != peer.endpoint) return false;
    const std::string& name = authority_.rule(source_).name;
    if (before == LinkState::kLost && from_ == peer.endpoint) {
        log_.limited({"host back", source_}, kRepeatAfter_s, Severity::kNotice,
                     "{} {} is back after {:.1f} s", name, to_string(from_), authority_.silent_s(source_));
    } else if (!spoken_for) {
        log_.limited({"host appeared", source_}, kRepeatAfter_s, Severity::kNotice,
                     "{} {} speaks CIGI {}, {}", name, to_string(from_), version_name(info.version),
                     order_name(info.order));
        peer.second_host_said = false;
    }
    if (!spoken_for) {
        peer.stamps.reset();
        if (session_source_ == source_) {
            session_source_.reset();
            // One that comes back finds what it has asked for, another does not hear it.
            if (from_ != peer.endpoint) outbox_.clear();
        }
    }
    if (authority_.heard(source_) && !spoken_for)
        raise(Event::kSourceHeard, static_cast<std::uint32_t>(source_), 0);
    peer.endpoint = from_;
    return true;
}

void World::say_second_host() {
    Peer& peer = peers_[source_];
    if (std::exchange(peer.second_host_said, true)) return;
    const SourceRule& rule = authority_.rule(source_);
    log_.warning("second {} {} ignored: {} is obeyed until it is silent for {} s", rule.name,
                 to_string(from_), to_string(peer.endpoint), rule.rights.lost_after_s);
}

void World::note_events(const cigi::SessionEvents& events) {
    counters_.frames_missed += events.frames_missed;
    if (events.host_restarted) {
        log_.limited({"host restarted", source_}, kRepeatAfter_s, Severity::kNotice,
                     "host {} began anew at its frame {}", to_string(from_),
                     session_.last_host_frame_number());
    }
    if (events.mode_changed) {
        log_.limited("mode", kRepeatAfter_s, Severity::kInfo, "host {} set mode {}", to_string(from_),
                     cigi::mode_name(session_.mode()));
    }
}

bool World::obeys(config::Aspect aspect) noexcept {
    switch (verdict_) {
        case Verdict::kObeyed:
            if (authority_.claim(source_, aspect)) return true;
            ++counters_.not_in_charge;
            return false;
        case Verdict::kStandby:
            ++counters_.standby_ignored;
            return false;
        case Verdict::kLate:
            ++counters_.late_ignored;
            return false;
        case Verdict::kNoControl:
            ++counters_.no_host;
            return false;
        case Verdict::kOtherHost:  // counted once a message
            return false;
    }
    return false;
}

void World::reset() {
    const ephemeris::UtcClockTime before = clock_.utc();
    clock_ = UtcClock(default_utc_, config_.start.running);
    note_clock_step(before);
    ownship_ = configured_ownship(config_.start);
    own_ = {};
    own_.track.reset(ownship_);
    entities_.clear();
    earth_ = {};
    celestial_ = configured_celestial(config_.sky);
    set_start_weather();
    views_.reset();
    surfaces_.clear();
    outbox_.clear();
    ++resets_;
}

void World::take_settings() {
    start_weather_ = server::start_weather(config_);
    const std::vector<SourceRule> rules = source_rules(config_);
    for (std::size_t source = 0; source < rules.size(); ++source)
        authority_.take_rights(source, rules[source].rights);
    if (!authority_.holder(config::Aspect::kWeather)) set_start_weather();
}

void World::set_start_weather() noexcept {
    air_ = configured_air(start_weather_.air);
    weather_.clear();
    for (const cigi::EnvRegionControl& region : start_weather_.regions)
        if (!weather_.set(region)) ++counters_.weather_full;
    for (const cigi::WeatherControl& layer : start_weather_.layers)
        if (!weather_.set(layer)) ++counters_.weather_full;
}

void World::operator()(const cigi::CelestialSphereControl& packet) {
    if (!obeys(config::Aspect::kTime)) return;
    celestial_ = {packet.sun_enable, packet.moon_enable, packet.star_enable,
                  static_cast<double>(packet.star_intensity) / 100.0};
    const ephemeris::UtcClockTime before = clock_.utc();
    if (!clock_.apply(packet)) {
        ++counters_.clock_refused;
        return;
    }
    note_clock_step(before);
}

void World::note_clock_step(const ephemeris::UtcClockTime& before) {
    const double step_s = ephemeris::seconds_between(before, clock_.utc());
    if (std::abs(step_s) <= kClockJump_s) return;
    time_s_ += step_s;
    const ephemeris::CivilTime now = clock_.utc().civil();
    log_.limited("clock", kRepeatAfter_s, Severity::kInfo,
                 "clock set to {:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", now.year, now.month, now.day, now.hour,
                 now.minute, static_cast<int>(now.second));
    raise(Event::kClockSet, cigi::make_date({now.year, now.month, now.day}),
          static_cast<std::uint32_t>(now.hour * 10000 + now.minute * 100 + static_cast<int>(now.second)));
}

void World::operator()(const cigi::AtmosphereControl& packet) {
    if (!obeys(config::Aspect::kWeather)) return;
    air_.model_enabled = packet.model_enable;
    air_.humidity_pct = packet.humidity;
    air_.visibility_m = static_cast<double>(packet.visibility);
    if (!take(static_cast<double>(packet.wind_horizontal), 0.0, kMostWind_m_s, air_.wind_horizontal_m_s))
        ++counters_.air_refused;
    if (!take(static_cast<double>(packet.wind_vertical), -kMostUpdraught_m_s, kMostUpdraught_m_s,
              air_.wind_vertical_m_s))
        ++counters_.air_refused;
    air_.wind_from_deg = static_cast<double>(packet.wind_direction);
    if (!take(static_cast<double>(packet.air_temperature), -100.0, 100.0, air_.temperature_c))
        ++counters_.air_refused;
    if (!take(static_cast<double>(packet.pressure), 300.0, 1200.0, air_.pressure_hpa))
        ++counters_.air_refused;
}

void World::operator()(const cigi::WeatherControl& packet) {
    if (obeys(config::Aspect::kWeather)) keep_weather(packet);
}

void World::keep_weather(const cigi::WeatherControl& told) {
    keep_limited(told);
}

void World::keep_weather(const cigi::EnvRegionControl& told) {
    keep_limited(told);
}

template <class Weather>
void World::keep_limited(Weather told) {
    if (limit(told)) {
        ++counters_.weather_limited;
        outbox_.messages.add(
            Matter::kPacketIgnored,
            "weather beyond what is drawn (wind {:g} m/s, {:g} m thick): the nearest is taken", kMostWind_m_s,
            kThickestLayer_m);
        log_.limited(
            "weather limited", kRepeatAfter_s, Severity::kWarning,
            "weather beyond what can be drawn: winds to {} m/s, bases to {} m, {} m thick, areas to {} m; "
            "the nearest is taken",
            kMostWind_m_s, kHighestLayer_m, kThickestLayer_m, 2.0 * kLargestArea_m);
    }
    if (!weather_.set(told)) ++counters_.weather_full;
}

void World::operator()(const cigi::EnvRegionControl& packet) {
    if (!obeys(config::Aspect::kWeather)) return;
    keep_weather(packet);
    if (packet.region_state == cigi::RegionState::kDestroyed) surfaces_.forget_region(packet.region_id);
}

void World::operator()(const cigi::ViewControl& packet) {
    if (obeys(config::Aspect::kViews)) note_view(views_.apply(packet), packet.view_id);
}

void World::operator()(const cigi::ViewDefinition& packet) {
    if (obeys(config::Aspect::kViews)) note_view(views_.apply(packet), packet.view_id);
}

void World::note_view(ViewResult result, std::uint16_t view_id) {
    struct Fault {
        std::uint64_t Counters::*counter;
        const char* text;
    };
    const auto fault = [result]() -> Fault {
        switch (result) {
            case ViewResult::kUnknownView:
                return {&Counters::unknown_view, "no channel has this view_id"};
            case ViewResult::kOtherEntity:
                return {&Counters::view_entity, "only the ownship (entity 0) carries views"};
            case ViewResult::kFarAway:
                return {&Counters::view_offset, "its offset is out of reach"};
            case ViewResult::kBadFrustum:
                return {&Counters::frustum_refused, "its half angles leave no picture"};
            case ViewResult::kReplication:
                return {&Counters::replication_refused,
                        "pixel replication 4 to 7 is not drawn: 0 none, 1 two high, 2 two wide, 3 both"};
            case ViewResult::kDone:
                break;
        }
        return {nullptr, ""};
    }();
    if (fault.counter == nullptr) return;
    ++(counters_.*fault.counter);
    // The text is a literal, one for each fault: it serves as the key.
    log_.limited(fault.text, kRepeatAfter_s, Severity::kWarning, "view {}: {}", view_id, fault.text);
    outbox_.messages.add(Matter::kPacketIgnored, "view {}: {}", view_id, fault.text);
}

void World::advance(double step_s) {
    if (!(step_s > 0.0) || !std::isfinite(step_s)) return;
    time_s_ += step_s;
    // What came before this step came at its start: the same instant is drawn.
    own_.track.advance(elapsed_s_);
    static_cast<Pose&>(ownship_) = own_.track.at(elapsed_s_ + ahead_s_);
    if (own_.clamped) ownship_.position.height_m = sea_height_m(ownship_.position);
    for (Entity& entity : entities_.all())
        entity.mover.track.advance(elapsed_s_);
    drawn_s_ = elapsed_s_;
    elapsed_s_ += step_s;
    clock_.advance(step_s);
    if (!config_.start.utc) default_utc_.advance(step_s);
    supervise(step_s);
    outbox_.messages.advance(step_s);
    counters_.ig_message_lost = outbox_.messages.left_out();
}

void World::stand_at(const ephemeris::UtcClockTime& utc, double time_s,
                     std::uint32_t ig_frame_number) noexcept {
    clock_.stand_at(utc);
    time_s_ = time_s;
    session_.count_from(ig_frame_number);
}

void World::supervise(double step_s) {
    authority_.advance(step_s, [this](const LinkChange& change) {
        if (change.to != LinkState::kLost) return;
        // What it has told to move is held where it is.
        note_smoothing(change.source, false);
        raise(Event::kSourceLost, static_cast<std::uint32_t>(change.source),
              static_cast<std::uint32_t>(authority_.losses(change.source)));
        const SourceRule& rule = authority_.rule(change.source);
        const std::string who = rule.kind == config::SourceKind::kCigi
                                    ? rule.name + ' ' + to_string(peers_[change.source].endpoint)
                                    : rule.name;
        log_.limited({"host lost", change.source}, kRepeatAfter_s, Severity::kWarning,
                     "{} lost: silent for {:.1f} s; the picture stays as it was, its clock goes on", who,
                     authority_.silent_s(change.source));
    });
}

}  // namespace skyig::server::world
