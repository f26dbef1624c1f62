// Every model of light in a plane slab of cloud: its errors against the slab truth and what a look-up costs.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

/// Throws std::runtime_error naming the table that is missing under `truth`/weather.
[[nodiscard]] Report measure_cloud_errors(const std::filesystem::path& truth);
[[nodiscard]] std::vector<Contender> cloud_contenders();
/// One phase function.
[[nodiscard]] Work cloud_floor();

}  // namespace skyig::clients::bench
