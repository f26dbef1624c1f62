// The words of `skyig sky` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// `options` holds them once the verb has parsed.
void add_sky(CLI::App& verb, SkyOptions& options);

}  // namespace skyig::clients
