// The words of `skyig metar` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Adds the verb; its options are in `options` once `app` has parsed.
CLI::App* add_metar(CLI::App& app, MetarOptions& options);

}  // namespace skyig::clients
