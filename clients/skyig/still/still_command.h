// The words that describe one moment, for all verbs that take one.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// `options` holds them once the verb has parsed.
void add_still(CLI::App& verb, StillOptions& options);

}  // namespace skyig::clients
