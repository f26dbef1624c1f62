#include <algorithm>
#include <cmath>

#include "server/pace.h"

namespace skyig::server {

std::optional<FramePacer::Slot> DisplayPace::next() {
    // A refresh may come early by the jitter of the thread that waits for it, not by half a period.
    constexpr double kTooSoon = 0.5;
    std::int64_t now_ns = clock_.monotonic_ns();
    if (!started_) {
        started_ = true;
        origin_ns_ = last_ns_ = now_ns;
        return FramePacer::Slot{now_ns, 0, false};
    }
    const double period_ns = period_s_ * 1e9;
    const auto since_ns = static_cast<double>(now_ns - last_ns_);
    if (since_ns < kTooSoon * period_ns) {
        ++spaced_;
        clock_.sleep_until_ns(last_ns_ + std::llround(period_ns));
        now_ns = clock_.monotonic_ns();
    }
    const auto refreshes =
        std::max<std::int64_t>(std::llround(static_cast<double>(now_ns - last_ns_) / period_ns), 1);
    std::int64_t slots = refreshes;
    const double ahead =
        static_cast<double>(slots_ + slots) - static_cast<double>(now_ns - origin_ns_) / period_ns;
    if (ahead > 1.0) --slots;
    if (ahead < -1.0) ++slots;
    slots_ += slots;
    last_ns_ = now_ns;
    return FramePacer::Slot{now_ns, static_cast<std::uint64_t>(slots), refreshes > 1};
}

}  // namespace skyig::server
