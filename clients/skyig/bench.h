// skyig bench: measures a family of models, error and cost, and writes the pages of docs/accuracy.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

/// \return the exit status. Throws std::runtime_error when a table or file is missing or bad.
int run_bench(const BenchOptions& options);

}  // namespace skyig::clients
