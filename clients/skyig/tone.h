// skyig tone: what luminances are shown as, by the shader that draws.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// A line of JSON for each luminance. Returns the exit status: 0, or 1 when the work failed.
[[nodiscard]] int run_tone(const ToneOptions& options);

}  // namespace skyig::clients
