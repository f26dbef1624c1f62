// skyig bench preview: what reading pictures back and making previews of them adds to frames.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Prints a table in Markdown, or JSON. \return the exit status
[[nodiscard]] int run_preview_cost(const BenchOptions& options);

}  // namespace skyig::clients
