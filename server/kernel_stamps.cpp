#include "server/kernel_stamps.h"

#include <cstdlib>
#include <limits>

namespace skyig::server {

namespace {

/// Less is the clock being steered, or our readings of it.
constexpr std::int64_t kStep_ns = 1'000'000;
/// So old may be what a flood has left in the queue, and so much may come while a lot is taken.
constexpr std::int64_t kOldest_ns = 10'000'000'000;
constexpr std::int64_t kNewest_ns = 50'000'000;
/// Of stamps and looks together.
constexpr std::int64_t kSlack_ns = 200'000;

/// Whoever takes the processor away between two readings spoils them: the closest of some tries holds.
std::int64_t utc_ahead_ns(const Clock& clock) noexcept {
    constexpr int kTries = 8;
    constexpr std::int64_t kClose_ns = 5'000;
    std::int64_t ahead_ns = 0;
    std::int64_t closest_ns = std::numeric_limits<std::int64_t>::max();
    for (int i = 0; i < kTries && closest_ns > kClose_ns; ++i) {
        const std::int64_t before_ns = clock.steady_utc_ns();
        const std::int64_t utc_ns = clock.utc_ns();
        const std::int64_t took_ns = clock.steady_utc_ns() - before_ns;
        if (took_ns >= closest_ns) continue;
        closest_ns = took_ns;
        ahead_ns = utc_ns - (before_ns + took_ns / 2);
    }
    return ahead_ns;
}

}  // namespace

KernelStamps::KernelStamps(const Clock& clock) noexcept
    : clock_(clock),
      looked_ns_(clock.steady_utc_ns()),
      looked_before_ns_(looked_ns_),
      ahead_ns_(utc_ahead_ns(clock)),
      ahead_before_ns_(ahead_ns_),
      stepped_at_ns_(looked_ns_ - kOldest_ns) {}

void KernelStamps::look() noexcept {
    const std::int64_t ahead_ns = utc_ahead_ns(clock_);
    looked_before_ns_ = looked_ns_;
    looked_ns_ = clock_.steady_utc_ns();
    if (std::abs(ahead_ns - ahead_ns_) >= kStep_ns) {
        last_step_ns_ = ahead_ns - ahead_ns_;
        ahead_before_ns_ = ahead_ns_;
        stepped_at_ns_ = looked_ns_;
        ++steps_;
    }
    ahead_ns_ = ahead_ns;
}

std::int64_t KernelStamps::steady_ns(std::int64_t stamp_utc_ns) const noexcept {
    const std::int64_t now_ns = stamp_utc_ns - ahead_ns_;
    const std::int64_t oldest_ns = looked_ns_ - kOldest_ns;
    if (stepped_at_ns_ > oldest_ns) {
        // What came between the last two looks is the likeliest, then what waited from before the step.
        if (now_ns >= looked_before_ns_ - kSlack_ns && now_ns <= looked_ns_ + kSlack_ns) return now_ns;
        const std::int64_t before_ns = stamp_utc_ns - ahead_before_ns_;
        if (before_ns >= oldest_ns && before_ns <= stepped_at_ns_ + kSlack_ns) return before_ns;
    }
    return now_ns >= oldest_ns && now_ns <= looked_ns_ + kNewest_ns ? now_ns : looked_ns_;
}

}  // namespace skyig::server
