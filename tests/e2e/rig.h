// A site with a host and an instructor on ports of their own, and runs of the daemon over recordings of it.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "tests/e2e/process.h"
#include "tests/e2e/site.h"

namespace skyig::tests {

/// One channel of 64x48 at 60 Hz. The host owns all but the weather, an instructor on another port owns that.
struct Rig {
    ScratchDirectory scratch;
    std::uint16_t host_port = free_port();
    std::uint16_t reply_port = free_port();
    std::uint16_t instructor_port = free_port();

    /// \param start_utc  nothing: now
    [[nodiscard]] std::string settings(
        const std::optional<std::string>& start_utc = {},
        const std::string& host_owns = R"(["control", "ownship", "time", "views"])",
        const std::string& instructor_owns = R"(["weather"])") const;
};

/// What a replay leaves behind, and how it ended.
struct Replayed {
    Finished finished;
    /// "frame channel hash" a line.
    std::string hashes;
    /// "frame text" a line.
    std::string events;
    std::string report;
};

/// Runs a recording as fast as it goes.
[[nodiscard]] Replayed replay(const std::string& daemon, const std::string& config_path,
                              const std::string& recording, const std::vector<std::string>& more = {},
                              std::chrono::seconds limit = std::chrono::seconds(60));

/// Lines of `events` from frame 1 on, without that of another renderer: what does not depend on machine and
/// paths.
[[nodiscard]] std::string events_of_frames(const std::string& events);

[[nodiscard]] long line_count(const std::string& text);

}  // namespace skyig::tests
