#include "server/host_timing.h"

#include <algorithm>
#include <cmath>

namespace skyig::server {

void HostTiming::heard(const protocol::cigi::IgControl& control, std::int64_t arrival_ns) noexcept {
    constexpr std::int64_t kSilence_ns = 1'000'000'000;
    const bool goes_on = last_ns_ && arrival_ns >= *last_ns_ && arrival_ns - *last_ns_ < kSilence_ns;
    if (goes_on) {
        interval_.add(arrival_ns - *last_ns_);
    } else {
        stamps_.reset();
        offset_.reset();
        origin_ns_ = arrival_ns;
    }
    last_ns_ = arrival_ns;
    if (!control.timestamp_valid) {
        stamps_.reset();
        offset_.reset();
        return;
    }
    const double arrival_s = static_cast<double>(arrival_ns - origin_ns_) * 1e-9;
    const double sender_s = stamps_.seconds(control.timestamp);
    if (!offset_.learn(arrival_s, sender_s)) return;
    const double later_s = arrival_s - sender_s - offset_.value_s();
    jitter_.add(std::llround(std::max(later_s, 0.0) * 1e9));
}

}  // namespace skyig::server
