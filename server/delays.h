// The image generator's share of the delay: from a message's arrival in the kernel to the picture that shows
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/arrivals.h"
#include "server/time_histogram.h"

namespace skyig::server {

/// Each message of a frame counts once in each channel, until its pixels are finished (the painter has waited
/// for them), and once in all of them, until they have been handed to the windows. Allocates nothing.
class Delays {
  public:
    explicit Delays(std::size_t channels) : channels_(channels) {}

    void finished(std::size_t channel, std::int64_t utc_ns, const Arrivals& arrivals) noexcept {
        add(channels_[channel], utc_ns, arrivals);
    }
    void shown(std::int64_t utc_ns, const Arrivals& arrivals) noexcept { add(shown_, utc_ns, arrivals); }

    [[nodiscard]] const TimeHistogram& channel(std::size_t index) const noexcept { return channels_[index]; }
    [[nodiscard]] const TimeHistogram& shown() const noexcept { return shown_; }

  private:
    static void add(TimeHistogram& times, std::int64_t utc_ns, const Arrivals& arrivals) noexcept {
        for (const std::int64_t arrival_ns : arrivals.times_ns())
            times.add(utc_ns - arrival_ns);
    }

    std::vector<TimeHistogram> channels_;
    TimeHistogram shown_;
};

}  // namespace skyig::server
