// skyig status, skyig top: what a running daemon tells of itself.
#pragma once

#include "clients/skyig/options.h"
#include "server/clock.h"

namespace skyig::clients {

/// \return the exit status: 1 after one line on stderr when nobody answers. A watch ends by a signal, or when
/// nobody answers the first time; later silences are told in the page's place.
[[nodiscard]] int run_status(const StatusOptions& options);

/// The same on a clock, ending a watch after so many pages (tests).
[[nodiscard]] int run_status(const StatusOptions& options, server::Clock& clock, int most_pages);

}  // namespace skyig::clients
