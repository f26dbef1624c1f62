// skyig sky: luminance and colour of the sky for a table of directions.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Returns the exit status: 0, 1 when a row was bad or the work failed, 2 when the air's file is wrong.
[[nodiscard]] int run_sky(const SkyOptions& options);

}  // namespace skyig::clients
