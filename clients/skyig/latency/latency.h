// skyig latency.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Flips an aircraft's attitude in front of a running daemon and tells after how long its pictures were
/// finished, as the daemon stamps it. \return the exit status: 1 too where a p99 is above `at_most_frames`
[[nodiscard]] int run_latency(const LatencyOptions& options);

}  // namespace skyig::clients
