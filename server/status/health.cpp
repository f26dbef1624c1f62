#include <fmt/format.h>

#include <algorithm>

#include "server/status/account.h"

namespace skyig::server::status {

namespace {

/// A frame may take long; one that takes longer than both of these is stuck.
constexpr double kStuckAfter_s = 1.0;
constexpr double kStuckAfterPeriods = 10.0;
/// Fewer frames say nothing of being late.
constexpr std::size_t kFewFrames = 30;

}  // namespace

Health health_of(const Facts& facts, const Snapshot& snapshot, std::int64_t now_ns) {
    if (snapshot.frames == 0) return {false, "no frame yet"};
    const double silent_s = static_cast<double>(now_ns - snapshot.record.end_ns()) * 1e-9;
    if (silent_s > std::max(kStuckAfter_s, kStuckAfterPeriods / facts.rate_hz))
        return {false, fmt::format("no frame for {:.1f} s", silent_s)};
    const RecentFrames recent = snapshot.record.recent();
    if (recent.frames >= kFewFrames && 2 * recent.late > recent.frames)
        return {false, fmt::format("{} of the last {} frames were late", recent.late, recent.frames)};
    for (std::size_t i = 0; i < facts.channels.size(); ++i) {
        const ChannelHealth& channel = snapshot.health[i];
        if (channel.failed)
            return {false,
                    fmt::format("channel {} cannot be drawn: {}", facts.channels[i], channel.reason())};
        if (snapshot.hidden[i])
            return {false, fmt::format("channel {} is not shown: its monitor is gone", facts.channels[i])};
    }
    return {true, "ok"};
}

std::string thinning_reason(const Thinning& thinning) {
    if (!thinning.any_step) return {};
    return fmt::format("{} {}: a frame took {:.0f} % of its time{}",
                       config::thinning_name(static_cast<config::Thinning>(thinning.last_thing)),
                       thinning.last_thinned ? "left out" : "is back", thinning.last_load * 100.0,
                       thinning.exhausted ? "; nothing more can be left out" : "");
}

}  // namespace skyig::server::status
