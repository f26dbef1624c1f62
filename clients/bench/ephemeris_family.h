// The family `ephemeris`: where Sun, Moon and planets stand, by every model of server/ephemeris.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

/// Needs ephemeris/geo_truth.csv and ephemeris/topo_truth.csv under `truth`.
[[nodiscard]] Report measure_ephemeris_errors(const std::filesystem::path& truth);
[[nodiscard]] std::vector<Contender> ephemeris_contenders();
/// A sky that only turns: three angles from memory, the matrix of their rotations, seven vectors turned by
/// it. Nothing that shows seven bodies from a turning Earth does less.
[[nodiscard]] Work ephemeris_floor();

}  // namespace skyig::clients::bench
