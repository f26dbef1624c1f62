// When frames begin, and how far the world moves from one to the next: by a clock, or by a recording.
#pragma once

#include <cstdint>
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
    /// Frames are those of a recording, with what they leave out.
    [[nodiscard]] virtual bool replays() const noexcept { return false; }
    /// Frames that the clock has spaced where a display should have.
    [[nodiscard]] virtual std::uint64_t spaced() const noexcept { return 0; }
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

/// Frames begin when the swap of a window, which has waited for a refresh of its display, has returned: the
/// loop asks for the next right then. The world moves on by whole periods and stays within one of the clock:
/// where the display is a little off the rate, a frame takes none or two once in a while. A frame during
/// which a refresh went by is late. A swap that does not wait (no display, a driver's setting) makes no
/// frames without end: then it is the clock that spaces them.
class DisplayPace final : public Pace {
  public:
    DisplayPace(Clock& clock, double rate_hz) noexcept : clock_(clock), period_s_(1.0 / rate_hz) {}

    [[nodiscard]] std::optional<FramePacer::Slot> next() override;
    [[nodiscard]] double period_s() const noexcept override { return period_s_; }
    [[nodiscard]] std::uint64_t spaced() const noexcept override { return spaced_; }

  private:
    Clock& clock_;
    double period_s_;
    std::int64_t origin_ns_ = 0;
    std::int64_t last_ns_ = 0;
    std::int64_t slots_ = 0;
    std::uint64_t spaced_ = 0;
    bool started_ = false;
};

}  // namespace skyig::server
