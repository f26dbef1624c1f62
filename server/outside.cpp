#include "server/outside.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "server/endpoint_format.h"

namespace skyig::server {

namespace {

std::string_view bus_text(protocol::transport::CanState state) {
    switch (state) {
        case protocol::transport::CanState::kMissing:
            return " (waiting: there is no CAN interface of this name)";
        case protocol::transport::CanState::kDown:
            return " (waiting: it is down)";
        case protocol::transport::CanState::kUp:
            break;
    }
    return "";
}

/// Who is heard where: "CIGI on udp 127.0.0.1:8004, answers to 127.0.0.1:8005; instructor on udp ...".
std::string heard_text(const config::Config& config, const LiveWire& wire) {
    std::string text = "no host";
    if (const auto local = wire.local(0)) {
        text = fmt::format("CIGI on udp {}, answers to {}", *local,
                           config.host.reply_to ? fmt::format("{}:{}", config.host.reply_to->address,
                                                              config.host.reply_to->port)
                                                : std::string("the sender"));
    }
    for (std::size_t i = 0; i < config.sources.size(); ++i) {
        const config::Source& source = config.sources[i];
        if (const auto local = wire.local(i + 1)) {
            fmt::format_to(std::back_inserter(text), "; {} on udp {}", source.name, *local);
        } else if (const protocol::transport::CanReceiver* bus = wire.bus(i + 1)) {
            fmt::format_to(std::back_inserter(text), "; {} on {}{}", source.name, bus->interface(),
                           bus_text(bus->state()));
        }
    }
    return text;
}

}  // namespace

Outside::Outside(const DaemonOptions& options, const config::Config& config, Clock& wall,
                 ManualClock& replay_clock, Log& log, bool hears) {
    if (!options.replay_path.empty()) {
        replay_.emplace(options.replay_path, config);
        replay_wire_.emplace(*replay_);
        replay_pace_.emplace(*replay_, replay_clock, wall, config.daemon.rate_hz, options.replay_speed);
        return;
    }
    if (hears) live_.emplace(config, wall, log);
    const bool wanted = config.daemon.pacing == config::Pacing::kDisplay;
    if (wanted && !options.headless) {
        live_pace_ = std::make_unique<DisplayPace>(wall, config.daemon.rate_hz);
    } else {
        live_pace_ = std::make_unique<ClockPace>(wall, config.daemon.rate_hz);
    }
    if (wanted && options.headless) log.notice("without windows frames are paced by the clock");
}

void Outside::record(const std::string& path, const config::Config& config, const RecordingFacts& facts) {
    recorder_ = std::make_unique<Recorder>(path, config, facts);
    recording_wire_.emplace(*plain_wire(), *recorder_);
}

void Outside::finish() {
    if (recorder_) recorder_->finish();
}

Wire* Outside::wire() {
    if (recording_wire_) return &*recording_wire_;
    return plain_wire();
}

Wire* Outside::plain_wire() {
    if (replay_wire_) return &*replay_wire_;
    return live_ ? &*live_ : nullptr;
}

Pace& Outside::pace() {
    if (replay_pace_) return *replay_pace_;
    return *live_pace_;
}

std::string Outside::heard(const DaemonOptions& options, const config::Config& config) const {
    if (live_) return heard_text(config, *live_);
    if (replay_) return fmt::format("replays {}", options.replay_path);
    return "hears its leader alone";
}

}  // namespace skyig::server
