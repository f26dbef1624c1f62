// skyig bench thinning: what each thing of [overload] saves where it is drawn.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Prints a table in Markdown, or JSON. \return the exit status
[[nodiscard]] int run_thinning(const BenchOptions& options);

}  // namespace skyig::clients
