// skyig record: writes down what comes to UDP ports and over CAN buses, without a daemon.
#pragma once

#include "clients/skyig/options.h"
#include "server/clock.h"

namespace skyig::clients {

/// Until SIGINT, SIGTERM or the end of its time. What is written may be cut off anywhere: it can be read.
/// \return the exit status: 0, or 1 after one line on stderr (a port, a bus or the file cannot be had)
[[nodiscard]] int run_record(const RecordOptions& options);

/// The same in the time of this clock.
[[nodiscard]] int run_record(const RecordOptions& options, server::Clock& clock);

}  // namespace skyig::clients
