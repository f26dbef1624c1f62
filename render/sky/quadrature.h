// Gauss-Legendre nodes and weights on [-1, 1].
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace skyig::render::sky {

template <std::size_t N>
struct GaussLegendre {
    std::array<double, N> node{};
    std::array<double, N> weight{};
};

/// Newton's iteration on the Legendre polynomial from the usual cosine guess; exact to rounding.
template <std::size_t N>
[[nodiscard]] GaussLegendre<N> gauss_legendre() {
    GaussLegendre<N> rule;
    for (std::size_t i = 0; i < N; ++i) {
        double x = -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (double(N) + 0.5));
        double slope = 1.0;
        for (int pass = 0; pass < 8; ++pass) {
            double previous = 1.0;
            double value = x;
            for (std::size_t k = 2; k <= N; ++k) {
                const double order = static_cast<double>(k);
                const double next = ((2.0 * order - 1.0) * x * value - (order - 1.0) * previous) / order;
                previous = value;
                value = next;
            }
            slope = double(N) * (x * value - previous) / (x * x - 1.0);
            x -= value / slope;
        }
        rule.node[i] = x;
        rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

}  // namespace skyig::render::sky
