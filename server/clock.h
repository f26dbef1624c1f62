// Time as the server measures it. This is the only place in the server that asks the system for it;
// everything else is handed a Clock (frame loop, log) or a step in seconds (world), so that tests and replay
// drive time by hand.
#pragma once

#include <cstdint>

namespace skyig::server {

class Clock {
  public:
    Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;
    Clock(Clock&&) = delete;
    Clock& operator=(Clock&&) = delete;
    virtual ~Clock() = default;

    /// Nanoseconds since an arbitrary instant; never steps.
    [[nodiscard]] virtual std::int64_t monotonic_ns() const noexcept = 0;
    /// UTC in nanoseconds since 1970-01-01T00:00:00Z, leap seconds not counted (POSIX). Steps when somebody
    /// sets the system's clock.
    [[nodiscard]] virtual std::int64_t utc_ns() const noexcept = 0;
    /// The same as it was when this clock was made, run on by monotonic_ns(): never steps. What is measured
    /// or recorded over a run is stamped by it.
    [[nodiscard]] virtual std::int64_t steady_utc_ns() const noexcept = 0;
    /// Processor time that all threads of the program have taken so far, nanoseconds; 0 where nobody
    /// measures.
    [[nodiscard]] virtual std::int64_t processor_ns() const noexcept { return 0; }
    /// Returns at or after the given instant of monotonic_ns(), at once if it has passed; a signal does not
    /// cut it short.
    virtual void sleep_until_ns(std::int64_t monotonic_deadline_ns) = 0;
};

/// CLOCK_MONOTONIC and CLOCK_REALTIME.
class SystemClock final : public Clock {
  public:
    SystemClock() noexcept;
    [[nodiscard]] std::int64_t monotonic_ns() const noexcept override;
    [[nodiscard]] std::int64_t utc_ns() const noexcept override;
    [[nodiscard]] std::int64_t steady_utc_ns() const noexcept override;
    [[nodiscard]] std::int64_t processor_ns() const noexcept override;
    void sleep_until_ns(std::int64_t monotonic_deadline_ns) override;

  private:
    std::int64_t steady_offset_ns_;
};

/// Stands still unless moved; sleeping moves it to the deadline. Processor time is what it is told.
class ManualClock final : public Clock {
  public:
    explicit ManualClock(std::int64_t monotonic_start_ns = 0, std::int64_t utc_start_ns = 0) noexcept
        : monotonic_ns_(monotonic_start_ns),
          steady_offset_ns_(utc_start_ns - monotonic_start_ns),
          utc_offset_ns_(steady_offset_ns_) {}

    [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return monotonic_ns_; }
    [[nodiscard]] std::int64_t utc_ns() const noexcept override { return monotonic_ns_ + utc_offset_ns_; }
    [[nodiscard]] std::int64_t steady_utc_ns() const noexcept override {
        return monotonic_ns_ + steady_offset_ns_;
    }
    [[nodiscard]] std::int64_t processor_ns() const noexcept override { return processor_ns_; }
    void sleep_until_ns(std::int64_t monotonic_deadline_ns) override;

    void spend_ns(std::int64_t step_ns) noexcept { processor_ns_ += step_ns; }
    void advance_ns(std::int64_t step_ns) noexcept { monotonic_ns_ += step_ns; }
    /// As when the system's clock is set: UTC steps, monotonic time does not.
    void step_utc_ns(std::int64_t step_ns) noexcept { utc_offset_ns_ += step_ns; }
    void advance_s(double step_s) noexcept { advance_ns(static_cast<std::int64_t>(step_s * 1e9)); }

  private:
    std::int64_t monotonic_ns_;
    std::int64_t steady_offset_ns_;
    std::int64_t utc_offset_ns_;
    std::int64_t processor_ns_ = 0;
};

}  // namespace skyig::server
