// The veil of fog, haze and their like, and the runway visual range.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

[[nodiscard]] Report measure_fog_errors(const std::filesystem::path& truth);
[[nodiscard]] std::vector<Contender> fog_contenders();
[[nodiscard]] Work fog_floor();

}  // namespace skyig::clients::bench
