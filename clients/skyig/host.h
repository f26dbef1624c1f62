// skyig host: flies a recorded flight at a daemon over CIGI and tells what it answers.
#pragma once

#include "clients/skyig/options.h"
#include "server/clock.h"

namespace skyig::clients {

/// \return the exit status: 0 when all of the flight was flown, 1 when it was interrupted (its results are
/// told all the same) or failed, 2 on wrong usage; what went wrong has then been told in one line on stderr
[[nodiscard]] int run_host(const HostOptions& options);

/// The same in the time of this clock.
[[nodiscard]] int run_host(const HostOptions& options, server::Clock& clock);

}  // namespace skyig::clients
