// The words of skyig instructor.
#pragma once

#include <CLI/App.hpp>

#include "clients/skyig/options.h"

namespace skyig::clients {

void add_instructor(CLI::App& app, InstructorOptions& options);
/// \throws CLI::ValidationError for an address that others reach, without a token
void check_instructor(const InstructorOptions& options);

}  // namespace skyig::clients
