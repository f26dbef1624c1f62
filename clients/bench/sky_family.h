// The family `sky`: the day-sky models as the renderer looks them up, against the truth tables.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

/// Reads sky/ and sky_scene/ under `truth`.
[[nodiscard]] Report measure_sky_errors(const std::filesystem::path& truth);
[[nodiscard]] std::vector<Contender> sky_contenders();
[[nodiscard]] Work sky_floor();

}  // namespace skyig::clients::bench
