// Medians and percentiles of durations in fixed memory, so that a frame can be timed without an allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace skyig::server {

/// Bins of equal ratio, 1 microsecond to 100 seconds; what lies outside counts in the outermost bins.
/// A quantile is within 0.5 % of the exact one inside that range.
class TimeHistogram {
  public:
    void add(std::int64_t duration_ns) noexcept;

    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    /// The duration that the fraction `q` (0..1) of all stay at or below, milliseconds; 0 when there are
    /// none.
    [[nodiscard]] double quantile_ms(double q) const noexcept;
    [[nodiscard]] double largest_ms() const noexcept { return static_cast<double>(largest_ns_) * 1e-6; }
    /// The one added last.
    [[nodiscard]] std::int64_t last_ns() const noexcept { return last_ns_; }

  private:
    static constexpr std::size_t kBins = 1852;

    std::array<std::uint32_t, kBins> bins_{};
    std::uint64_t count_ = 0;
    std::int64_t largest_ns_ = 0;
    std::int64_t last_ns_ = 0;
};

}  // namespace skyig::server
