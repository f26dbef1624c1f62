// skyig cloud: light of a plane slab of cloud, by the functions that draw.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Returns the exit status: 0, 1 when a row was bad or the work failed, 2 on wrong usage.
[[nodiscard]] int run_cloud(const CloudOptions& options);

}  // namespace skyig::clients
