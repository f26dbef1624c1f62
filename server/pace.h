// When frames begin, and how far the world moves from one to the next: by a clock, or by a recording.
#pragma once

#include <optional>

#include "server/clock.h"
#include "server/frame_pacer.h"

namespace skyig::server {

class Pace {
  public:
    Pace() = default;
    Pace(const Pace&) = delete;
    Pace& operator=(const Pace&) = delete;
    Pace(Pace&&) = delete;
    Pace& operator=(Pace&&) = delete;
    virtual ~Pace() = default;

    /// Returns when the next frame is to begin; nothing when there is none any more.
    [[nodiscard]] virtual std::optional<FramePacer::Slot> next() = 0;
    /// Of one slot.
    [[nodiscard]] virtual double period_s() const noexcept = 0;
};

/// Sleeps on a clock from one slot of the grid to the next, for ever.
class ClockPace final : public Pace {
  public:
    ClockPace(Clock& clock, double rate_hz) noexcept : clock_(clock), pacer_(rate_hz) {}

    [[nodiscard]] std::optional<FramePacer::Slot> next() override {
        const FramePacer::Slot slot = pacer_.next(clock_.monotonic_ns());
        clock_.sleep_until_ns(slot.start_ns);
        return slot;
    }
    [[nodiscard]] double period_s() const noexcept override { return pacer_.period_s(); }

  private:
    Clock& clock_;
    FramePacer pacer_;
};

}  // namespace skyig::server
