// What the frame loop hears and goes by: sockets and the system's clock, or a recording and its own.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "config/config.h"
#include "server/clock.h"
#include "server/daemon.h"
#include "server/live_wire.h"
#include "server/log.h"
#include "server/pace.h"
#include "server/recorder.h"
#include "server/replay.h"

namespace skyig::server {

class Outside {
  public:
    /// \param hears  false: nobody, by no socket \throws std::runtime_error with one line
    Outside(const DaemonOptions& options, const config::Config& config, Clock& wall,
            ManualClock& replay_clock, Log& log, bool hears = true);

    void record(const std::string& path, const config::Config& config, const RecordingFacts& facts);

    /// No more frames come.
    void finish();

    /// Null where nobody is heard.
    [[nodiscard]] Wire* wire();
    [[nodiscard]] Pace& pace();
    [[nodiscard]] const Replay* replay() const noexcept { return replay_ ? &*replay_ : nullptr; }
    [[nodiscard]] const LiveWire* live() const noexcept { return live_ ? &*live_ : nullptr; }
    [[nodiscard]] const Recorder* recorder() const noexcept { return recorder_.get(); }

    /// For people.
    [[nodiscard]] std::string heard(const DaemonOptions& options, const config::Config& config) const;

  private:
    [[nodiscard]] Wire* plain_wire();

    std::optional<LiveWire> live_;
    std::unique_ptr<Pace> live_pace_;
    std::optional<Replay> replay_;
    std::optional<ReplayWire> replay_wire_;
    std::optional<ReplayPace> replay_pace_;
    std::unique_ptr<Recorder> recorder_;
    std::optional<RecordingWire> recording_wire_;
};

}  // namespace skyig::server
