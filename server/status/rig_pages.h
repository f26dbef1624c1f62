// What the pages tell of a rig.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/status/account.h"
#include "server/status/metrics_text.h"

namespace skyig::server::status {

/// Null where this machine is alone.
[[nodiscard]] nlohmann::ordered_json rig_json(const Facts& facts, const RigState& rig);

/// Nothing where this machine is alone.
void add_rig(MetricsText& out, const RigState& rig);

}  // namespace skyig::server::status
