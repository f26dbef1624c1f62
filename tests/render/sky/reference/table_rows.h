// The reference solver against rows of the tables of tests/data/sky.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/sky/reference/sky_solver.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky::reference {

/// Numbers of every `stride`-th row.
inline std::vector<std::size_t> every_row(const Table& table, std::size_t stride) {
    std::vector<std::size_t> rows;
    for (std::size_t row = stride / 2; row < table.rows.size(); row += stride)
        rows.push_back(row);
    return rows;
}

inline View view_of(const Table& table, std::size_t row) {
    return {table.number(row, "altitude_m"), table.number(row, "sun_zenith_deg") * kDeg,
            table.number(row, "view_zenith_deg") * kDeg, table.number(row, "rel_azimuth_deg") * kDeg};
}

struct Agreement {
    std::size_t rows = 0;
    std::size_t within = 0;
    Errors all;           // relative, of the luminance
    Errors certain;       // of rows whose combined standard error is below 1 %
    Errors sigmas;        // over the combined standard error
    Errors chromaticity;  // of the certain rows, distance in x, y
    Errors single;        // relative, of light scattered once
    double sum_sigmas = 0.0;

    [[nodiscard]] double share_within() const {
        return rows > 0 ? static_cast<double>(within) / static_cast<double>(rows) : 0.0;
    }
    [[nodiscard]] double mean_sigmas() const { return sum_sigmas / static_cast<double>(rows); }
};

inline void add_row(const Table& table, std::size_t row, const Radiance& ours, Agreement& agreement) {
    const double luminance = table.number(row, "Y_cd_m2");
    if (!(luminance > 0.0)) {
        agreement.within += ours.xyz.y == 0.0 ? 1U : 0U;
        ++agreement.rows;
        return;
    }
    const double error = ours.xyz.y / luminance - 1.0;
    const double sigma = std::hypot(table.number(row, "rel_se_Y"), ours.luminance_error / luminance);
    agreement.within += std::abs(error) <= std::max(0.01, 3.0 * sigma) ? 1U : 0U;
    ++agreement.rows;
    agreement.all.add(error);
    agreement.sigmas.add(error / sigma);
    agreement.sum_sigmas += error / sigma;
    const double single = table.number(row, "Y_single_cd_m2");
    if (single > 1e-3 * luminance) agreement.single.add(ours.single_luminance / single - 1.0);
    if (sigma > 0.01) return;
    agreement.certain.add(error);
    const double sum = ours.xyz.x + ours.xyz.y + ours.xyz.z;
    agreement.chromaticity.add(
        std::hypot(ours.xyz.x / sum - table.number(row, "x"), ours.xyz.y / sum - table.number(row, "y")));
}

inline Agreement compare_with(const Table& table, const std::vector<std::size_t>& rows,
                              const SkySolver& solver, const Effort& effort, unsigned threads) {
    std::vector<View> views;
    for (const std::size_t row : rows)
        views.push_back(view_of(table, row));
    const std::vector<Radiance> radiances = solver.radiances(views, effort, threads);
    Agreement agreement;
    for (std::size_t i = 0; i < rows.size(); ++i)
        add_row(table, rows[i], radiances[i], agreement);
    return agreement;
}

}  // namespace skyig::render::sky::reference
