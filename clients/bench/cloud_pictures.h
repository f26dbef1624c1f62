// The ways of drawing clouds: what a ray through them costs, and how true impostors are to their particles.
#pragma once

#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

/// Without costs.
[[nodiscard]] std::vector<ModelEntry> cloud_pictures();
[[nodiscard]] std::vector<Contender> cloud_picture_contenders();

}  // namespace skyig::clients::bench
