// A weather report as one JSON object.
#pragma once

#include <string>

#include "protocol/metar/report.h"

namespace skyig::clients::metar {

/// One line without its end. The keys are those of tests/data/metar/metar_examples.json, in that order; all
/// are always there. What has no key (runway states, sea, wind shear, colours) is on the page alone.
[[nodiscard]] std::string to_json(const protocol::metar::Report& report);

/// All problems in one line; empty without any.
[[nodiscard]] std::string problems_text(const protocol::metar::Report& report);

}  // namespace skyig::clients::metar
