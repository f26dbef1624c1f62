// The kernel stamps what arrives by a clock that may be set at any time; what is measured from these stamps
// must not notice.
#pragma once

#include <cstdint>

#include "server/clock.h"

namespace skyig::server {

/// Turns stamps of CLOCK_REALTIME into those of Clock::steady_utc_ns(), also of messages that came before the
/// clock was set and are taken after. By how little it may be set without notice, 1 ms, a stamp may be off,
/// and by no more than the time between two looks for the messages between a step and the look after it.
/// Allocates nothing.
class KernelStamps {
  public:
    /// The clock must outlive it.
    explicit KernelStamps(const Clock& clock) noexcept;

    /// Before each lot of stamps that is turned: sees whether the clock has been set since the last look.
    void look() noexcept;

    /// Of what is taken after the last look. A stamp that neither the clock as it is nor as it was before it
    /// was set explains is taken as of that look.
    [[nodiscard]] std::int64_t steady_ns(std::int64_t stamp_utc_ns) const noexcept;

    /// How often the clock has been set; by how much the last time.
    [[nodiscard]] std::uint64_t steps() const noexcept { return steps_; }
    [[nodiscard]] std::int64_t last_step_ns() const noexcept { return last_step_ns_; }

  private:
    const Clock& clock_;
    std::int64_t looked_ns_;
    std::int64_t looked_before_ns_;
    /// UTC less steady UTC, now and before the last step.
    std::int64_t ahead_ns_;
    std::int64_t ahead_before_ns_;
    std::int64_t last_step_ns_ = 0;
    std::uint64_t steps_ = 0;
    std::int64_t stepped_at_ns_;
};

}  // namespace skyig::server
