// skyig plan: which passes one moment needs, how fine, how far off, and why.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Returns the exit status: 0, 1 when the work failed, 2 when the settings are wrong.
[[nodiscard]] int run_plan(const PlanOptions& options);

}  // namespace skyig::clients
