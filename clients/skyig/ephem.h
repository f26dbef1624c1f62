// skyig ephem: where Sun, Moon, planets and stars stand, for a moment or a table, and when things happen.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// \return the exit status; what failed has been told on stderr.
int run_ephem(const EphemOptions& options);

}  // namespace skyig::clients
