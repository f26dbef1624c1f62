// The words of skyig rvr.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Adds the verb; `options` holds its words once they are read.
void add_rvr(CLI::App& app, RvrOptions& options);

}  // namespace skyig::clients
