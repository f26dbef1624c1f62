// The words of skyig latency.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// `options` holds them once the verb has parsed.
void add_latency(CLI::App& app, LatencyOptions& options);

}  // namespace skyig::clients
