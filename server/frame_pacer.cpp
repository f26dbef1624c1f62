#include "server/frame_pacer.h"

#include <cmath>

namespace skyig::server {

FramePacer::FramePacer(double rate_hz) noexcept : period_ns_(1e9 / rate_hz) {}

// From the origin each time: adding rounded periods would drift.
std::int64_t FramePacer::deadline_ns(std::uint64_t slot) const noexcept {
    return origin_ns_ + std::llround(static_cast<double>(slot) * period_ns_);
}

FramePacer::Slot FramePacer::next(std::int64_t now_ns) noexcept {
    if (!started_) {
        started_ = true;
        origin_ns_ = now_ns;
        return {now_ns, 0, false};
    }
    ++slot_;
    const std::int64_t deadline = deadline_ns(slot_);
    if (now_ns <= deadline) return {deadline, 1, false};
    const auto passed = static_cast<std::uint64_t>(static_cast<double>(now_ns - deadline) / period_ns_);
    slot_ += passed;
    return {now_ns, 1 + passed, true};
}

}  // namespace skyig::server
