// The words of `skyig decode` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Adds the verb; its options are in `options` once `app` has parsed.
CLI::App* add_decode(CLI::App& app, DecodeOptions& options);

}  // namespace skyig::clients
