#include "server/time_histogram.h"

#include <algorithm>
#include <cmath>

namespace skyig::server {

namespace {

constexpr double kSmallestNs = 1000.0;
constexpr double kRatio = 1.01;

}  // namespace

void TimeHistogram::add(std::int64_t duration_ns) noexcept {
    const double ratio = std::max(static_cast<double>(duration_ns) / kSmallestNs, 1.0);
    const double bin = std::log(ratio) / std::log(kRatio);
    ++bins_[static_cast<std::size_t>(std::min(bin, static_cast<double>(kBins - 1)))];
    ++count_;
    largest_ns_ = std::max(largest_ns_, duration_ns);
    last_ns_ = duration_ns;
}

double TimeHistogram::quantile_ms(double q) const noexcept {
    if (count_ == 0) return 0.0;
    const double wanted = std::clamp(q, 0.0, 1.0) * static_cast<double>(count_);
    const auto rank = std::max<std::uint64_t>(static_cast<std::uint64_t>(std::ceil(wanted)), 1);
    std::uint64_t seen = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        seen += bins_[bin];
        if (seen < rank) continue;
        const double middle_ns = kSmallestNs * std::pow(kRatio, static_cast<double>(bin) + 0.5);
        return std::min(middle_ns * 1e-6, largest_ms());
    }
    return largest_ms();
}

}  // namespace skyig::server
