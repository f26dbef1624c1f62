// Everything that one page tells, gathered; and the pages: JSON for programs and people, Prometheus text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/report.h"
#include "server/status/snapshot.h"

namespace skyig::server::status {

struct RecorderState {
    std::string file;
    std::uint64_t written = 0;
    std::uint64_t lost = 0;
    std::uint64_t bytes = 0;
    bool failed = false;
};

/// What the status port itself has seen.
struct PortCounts {
    std::uint64_t connections = 0;
    /// Requests answered with a page.
    std::uint64_t answered = 0;
    /// Requests answered with a refusal (4xx, 5xx other than /healthz).
    std::uint64_t refused = 0;
    /// Connections that took too long, or gave way to others while they did nothing.
    std::uint64_t timed_out = 0;
};

struct Health {
    bool good = false;
    /// "ok", or one line that says what is wrong.
    std::string text;
};

/// Good while frames come and at most half of the last ones began late. \param now_ns  of the clock that the
/// frames are timed by
[[nodiscard]] Health health_of(const Facts& facts, const Snapshot& snapshot, std::int64_t now_ns);

struct Account {
    const Facts& facts;
    const Snapshot& snapshot;
    /// With the buses.
    RunReport report;
    std::optional<RecorderState> recorder;
    PortCounts port;
    Health health;
    double uptime_s = 0.0;
    /// Since the end of the frame that is told of.
    double age_s = 0.0;
};

/// "cloud-motion left out: a frame took 97 % of its time"; empty before the first step.
[[nodiscard]] std::string thinning_reason(const Thinning& thinning);

/// The report's keys, and what stands beside them while the daemon runs.
[[nodiscard]] std::string to_json(const Account& account);

/// Text format 0.0.4.
[[nodiscard]] std::string to_metrics(const Account& account);

}  // namespace skyig::server::status
