// A weather report as a page for people.
#pragma once

#include <string>

#include "protocol/metar/report.h"

namespace skyig::clients::metar {

/// Lines with their ends; what the report does not tell has none.
[[nodiscard]] std::string to_text(const protocol::metar::Report& report);

}  // namespace skyig::clients::metar
