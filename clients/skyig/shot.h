// skyig shot: one still of the sky, drawn by the daemon's own chain without a network.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// \return the exit status; what went wrong has then been told on stderr
[[nodiscard]] int run_shot(const ShotOptions& options);

}  // namespace skyig::clients
