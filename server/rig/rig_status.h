// A machine's part in its rig for the status pages.
#pragma once

#include <cstdint>

#include "server/rig/machine.h"
#include "server/status/rig_state.h"

namespace skyig::server::rig {

/// After a frame was shown. \param frame  its number \param state  all of it is written
void fill_status(const Machine& machine, std::uint64_t frame, status::RigState& state);

}  // namespace skyig::server::rig
