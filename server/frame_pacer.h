// When frames start: on a grid of absolute deadlines, without drift and without bursts.
#pragma once

#include <cstdint>

namespace skyig::server {

/// Pure arithmetic on monotonic nanoseconds; whoever owns the clock sleeps.
/// A frame that is not ready at its deadline is late and starts at once. What is left of the grid stays where
/// it was, so that the mean rate holds; grid slots that passed entirely are left out, so frames never come in
/// a burst.
class FramePacer {
  public:
    struct Slot {
        /// When the frame starts: wait until then. Never earlier than `now_ns` of the call.
        std::int64_t start_ns = 0;
        /// Grid slots since the frame before: 0 for the first frame, 1 on time, more when slots were left
        /// out.
        std::uint64_t slots = 0;
        /// The work of the frame before ended after this frame's deadline.
        bool late = false;
        /// Of a recording, or of another machine's frame: what it left out, by the numbers of render::Thin.
        std::uint64_t thinned = 0;
        /// Of another machine's frame: its number; 0 for this machine's next.
        std::uint64_t told_number = 0;
    };

    /// \param rate_hz  frames a second, greater than 0
    explicit FramePacer(double rate_hz) noexcept;

    /// The next frame, asked for when the work of the one before is done. The first call starts the grid.
    [[nodiscard]] Slot next(std::int64_t now_ns) noexcept;

    [[nodiscard]] double period_s() const noexcept { return period_ns_ * 1e-9; }

  private:
    [[nodiscard]] std::int64_t deadline_ns(std::uint64_t slot) const noexcept;

    double period_ns_;
    std::int64_t origin_ns_ = 0;
    std::uint64_t slot_ = 0;
    bool started_ = false;
};

}  // namespace skyig::server
