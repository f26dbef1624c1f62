// The one way in which the ephemeris tests keep the largest of their errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace skyig::tests {

/// Raises `largest` to the error's magnitude. Not-a-number counts as infinite: no bound lets it pass, where
/// std::max would drop it.
inline void raise(double& largest, double error) {
    largest =
        std::isfinite(error) ? std::max(largest, std::abs(error)) : std::numeric_limits<double>::infinity();
}

}  // namespace skyig::tests
