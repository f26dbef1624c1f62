// The pages of docs/accuracy: one a family, and one table over all of them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "clients/bench/report.h"

namespace skyig::clients::bench {

/// FAMILY.md: what was measured against what, the plots, tables of errors and costs.
[[nodiscard]] std::string family_page(const Report& report);
/// index.md: each model's headline error and cost.
[[nodiscard]] std::string index_page(std::span<const Report> reports);
/// FAMILY-PLOT.svg
[[nodiscard]] std::string plot_file_name(const Report& report, const Plot& plot);
[[nodiscard]] std::string plot_file_name(const Report& report, const CurvePlot& plot);

/// Reads every *.json in `folder`, in the order of their names, and writes pages and plots beside them.
/// \return what was written. Throws std::runtime_error naming the file that cannot be read or written.
std::vector<std::filesystem::path> render_pages(const std::filesystem::path& folder);

}  // namespace skyig::clients::bench
