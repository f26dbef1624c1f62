// skyig rvr: how far runway lights and marks are seen, or what extinction makes it so.
#pragma once

#include "clients/skyig/options.h"

namespace skyig::clients {

int run_rvr(const RvrOptions& options);

}  // namespace skyig::clients
