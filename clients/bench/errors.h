// How far a model is from the truth over many cases, as three figures.
#pragma once

#include <cstddef>
#include <vector>

namespace skyig::clients::bench {

/// All in the unit of the samples; all zero when there are none.
struct ErrorFigures {
    double max = 0.0;
    double rms = 0.0;
    /// Nearest rank: 95 % of the samples are not larger.
    double p95 = 0.0;
    std::size_t count = 0;

    friend bool operator==(const ErrorFigures&, const ErrorFigures&) = default;
};

/// Collects sizes of errors; signs are dropped.
class ErrorSamples {
  public:
    /// Throws std::domain_error when `error` is not finite: such a model has no figure.
    void add(double error);
    [[nodiscard]] ErrorFigures figures() const;

  private:
    std::vector<double> sizes_;
};

}  // namespace skyig::clients::bench
