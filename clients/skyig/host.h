// skyig host: flies a recorded flight at a daemon over CIGI and tells what it answers.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// \return the exit status; what went wrong has then been told in one line on stderr
[[nodiscard]] int run_host(const HostOptions& options);

}  // namespace skyig::clients
