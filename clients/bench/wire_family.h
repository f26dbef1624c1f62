// The family `wire`: CIGI 3.3 and 4.0 in both byte orders, read with every bound checked.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

[[nodiscard]] Report measure_wire_errors(const std::filesystem::path& truth);
[[nodiscard]] std::vector<Contender> wire_contenders();
[[nodiscard]] Work wire_floor();

}  // namespace skyig::clients::bench
