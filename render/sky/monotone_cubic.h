// Piecewise cubics through given values that overshoot nowhere (Fritsch and Butland 1984).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace skyig::render::sky {

/// Slope at a node between two chords.
[[nodiscard]] inline double monotone_slope(double before, double step_before, double after,
                                           double step_after) {
    if (before * after <= 0.0) return 0.0;
    const double weight = (step_before + 2.0 * step_after) / (3.0 * (step_before + step_after));
    return before * after / (weight * after + (1.0 - weight) * before);
}

/// Slopes at nodes of rising `x`; at the ends those of the chords.
inline void monotone_slopes(std::span<const double> x, std::span<const double> y, std::span<double> slope) {
    const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
    const std::size_t last = x.size() - 1;
    slope[0] = chord(0);
    slope[last] = chord(last - 1);
    for (std::size_t i = 1; i < last; ++i)
        slope[i] = monotone_slope(chord(i - 1), x[i] - x[i - 1], chord(i), x[i + 1] - x[i]);
}

/// Weights of a cubic piece at `t` of 0..1: values and slopes (times the step) at its ends.
struct Cubic {
    double value0, slope0, value1, slope1;
};
[[nodiscard]] constexpr Cubic cubic(double t) {
    const double s = 1.0 - t;
    return {s * s * (1.0 + 2.0 * t), s * s * t, t * t * (1.0 + 2.0 * s), -t * t * s};
}

/// Index of the node at the start of the piece that holds `x`.
[[nodiscard]] inline std::size_t piece_of(std::span<const double> nodes, double x) {
    const auto after = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    return static_cast<std::size_t>(after - nodes.begin()) - 1;
}

}  // namespace skyig::render::sky
