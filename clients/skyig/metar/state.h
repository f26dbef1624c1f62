// The weather that is drawn of a report, as one JSON object.
#pragma once

#include <string>

#include "protocol/metar/report.h"

namespace skyig::clients::metar {

/// One line without its end: the air, and the layers with heights above the ellipsoid.
[[nodiscard]] std::string state_json(const protocol::metar::Report& report, double elevation_m);

}  // namespace skyig::clients::metar
