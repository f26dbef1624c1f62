// The tone operators: how far single precision and the published tables are, and what a colour costs.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

/// \param truth  its folder "eye" holds tumblin_rushmeier.csv and default_operator.csv
[[nodiscard]] Report measure_eye_errors(const std::filesystem::path& truth);
[[nodiscard]] std::vector<Contender> eye_contenders();
[[nodiscard]] Work eye_floor();

}  // namespace skyig::clients::bench
