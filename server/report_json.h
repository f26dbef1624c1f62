// The report as a JSON value, for who adds to it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/report.h"

namespace skyig::server {

/// Every count by its name.
[[nodiscard]] nlohmann::ordered_json counts_json(const std::vector<NamedCount>& counts);
/// What to_json() prints.
[[nodiscard]] nlohmann::ordered_json report_json(const RunReport& report);

}  // namespace skyig::server
