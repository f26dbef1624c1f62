// The sources of the night's light: how far each is from what is known of it, and what it costs.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

/// \param truth  as night_rows() has it
[[nodiscard]] Report measure_night_errors(const std::filesystem::path& truth);
[[nodiscard]] std::vector<Contender> night_contenders();
[[nodiscard]] Work night_floor();

}  // namespace skyig::clients::bench
