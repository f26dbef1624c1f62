#include "clients/bench/errors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace skyig::clients::bench {

void ErrorSamples::add(double error) {
    if (!std::isfinite(error)) throw std::domain_error("bench: a model's error is not finite");
    sizes_.push_back(std::abs(error));
}

ErrorFigures ErrorSamples::figures() const {
    if (sizes_.empty()) return {};
    std::vector<double> sorted = sizes_;
    std::sort(sorted.begin(), sorted.end());
    double squares = 0.0;
    for (const double size : sorted)
        squares += size * size;
    const std::size_t count = sorted.size();
    const std::size_t rank = (95 * count + 99) / 100;
    return {sorted.back(), std::sqrt(squares / static_cast<double>(count)), sorted[rank - 1], count};
}

}  // namespace skyig::clients::bench
