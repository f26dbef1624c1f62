// skyig replay: sends the datagrams of a capture onto the network, at the pace at which they came.
#pragma once

#include <istream>

#include "clients/skyig/options.h"
#include "server/clock.h"

namespace skyig::clients {

/// Each sender of the capture gets a port of its own, so that whoever listens tells them apart as before.
/// \return the exit status: 0 when all was sent (a capture that is cut off ends where it is cut, which is
/// told), 1 when it was interrupted, is damaged, or nothing could be sent; told in one line on stderr
[[nodiscard]] int run_replay(const ReplayOptions& options);

/// The same in the time of this clock; with options.step each line of `steps` sends the next.
[[nodiscard]] int run_replay(const ReplayOptions& options, server::Clock& clock, std::istream& steps);

}  // namespace skyig::clients
