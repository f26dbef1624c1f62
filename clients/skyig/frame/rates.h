// skyig bench frame: frames a second of the renderer at hand, by picture size and scene, beside what the
// programs that skyig follows say of themselves.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Prints tables in Markdown, or JSON. \return the exit status
[[nodiscard]] int run_frame_rates(const BenchOptions& options);

}  // namespace skyig::clients
