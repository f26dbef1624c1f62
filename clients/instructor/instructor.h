// skyig instructor: the station as a program.
#pragma once

#include "clients/skyig/options.h"
#include "server/clock.h"

namespace skyig::clients {

/// Serves until SIGINT or SIGTERM. \return the exit status
[[nodiscard]] int run_instructor(const InstructorOptions& options);

}  // namespace skyig::clients
