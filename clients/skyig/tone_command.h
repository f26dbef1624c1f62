// The words of skyig tone.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Adds the verb; `options` holds its words once they are read.
void add_tone(CLI::App& app, ToneOptions& options);

}  // namespace skyig::clients
