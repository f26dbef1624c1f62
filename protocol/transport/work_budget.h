// How much of a processor a thread may take over time, so that whoever floods it cannot make it starve
// others.
#pragma once

#include <algorithm>
#include <cstdint>

namespace skyig::protocol::transport {

/// Credit grows with the time that passes, `share` seconds a second, up to `burst_ns`; work spends it. Pure
/// arithmetic: who owns the clocks tells both times, each from any origin.
class WorkBudget {
  public:
    /// \param share  of one processor, above 0; 1 and more never make anyone rest
    WorkBudget(double share, std::int64_t burst_ns) noexcept
        : share_(share), burst_ns_(static_cast<double>(burst_ns)), credit_ns_(burst_ns_) {}

    /// After a piece of work: how long to rest until the credit is no longer overdrawn; 0 as a rule.
    /// \param now_ns   of a steady clock  \param work_ns  processor time that the thread has taken so far
    [[nodiscard]] std::int64_t rest_ns(std::int64_t now_ns, std::int64_t work_ns) noexcept {
        if (started_) {
            const double earned_ns = share_ * static_cast<double>(now_ns - last_now_ns_);
            credit_ns_ = std::min(credit_ns_ + earned_ns, burst_ns_);
            credit_ns_ -= static_cast<double>(work_ns - last_work_ns_);
        }
        started_ = true;
        last_now_ns_ = now_ns;
        last_work_ns_ = work_ns;
        if (share_ >= 1.0 || credit_ns_ >= 0.0) return 0;
        return static_cast<std::int64_t>(-credit_ns_ / share_);
    }

  private:
    double share_;
    double burst_ns_;
    double credit_ns_;
    std::int64_t last_now_ns_ = 0;
    std::int64_t last_work_ns_ = 0;
    bool started_ = false;
};

}  // namespace skyig::protocol::transport
