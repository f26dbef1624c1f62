// The words of `skyig cloud` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Adds the verb; `options` holds its words once they are read.
void add_cloud(CLI::App& app, CloudOptions& options);

}  // namespace skyig::clients
