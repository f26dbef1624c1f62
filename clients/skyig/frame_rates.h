// skyig bench frame.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Frames a second of one channel in five sizes and of three, in four scenes, with the renderer's name,
/// beside what the programs that skyig follows say of themselves; and what each thing saves that [overload]
/// can leave out. `options.rounds` frames of each. \return the exit status
[[nodiscard]] int run_frame_rates(const BenchOptions& options);

}  // namespace skyig::clients
