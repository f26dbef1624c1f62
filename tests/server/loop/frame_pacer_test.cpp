#include "server/frame_pacer.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "server/clock.h"

namespace skyig::server {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Runs frames of a given work time on a hand-driven clock, as the loop does.
class Frames {
  public:
    explicit Frames(double rate_hz) : pacer_(rate_hz) {}

    FramePacer::Slot step(std::int64_t work_ns) {
        const FramePacer::Slot slot = pacer_.next(clock_.monotonic_ns());
        clock_.sleep_until_ns(slot.start_ns);
        clock_.advance_ns(work_ns);
        return slot;
    }
    [[nodiscard]] std::int64_t now_ns() const { return clock_.monotonic_ns(); }

  private:
    ManualClock clock_{1'000'000'007};
    FramePacer pacer_;
};

TEST(FramePacer, FirstFrameStartsAtOnce) {
    Frames frames(60.0);
    const FramePacer::Slot slot = frames.step(kMs);
    EXPECT_EQ(slot.start_ns, 1'000'000'007);
    EXPECT_EQ(slot.slots, 0U);
    EXPECT_FALSE(slot.late);
}

TEST(FramePacer, DoesNotDriftInADay) {
    FramePacer pacer(60.0);
    std::int64_t now = 0;
    constexpr std::int64_t kFrames = 60 * 86'400;
    for (std::int64_t i = 0; i <= kFrames; ++i) {
        const FramePacer::Slot slot = pacer.next(now);
        ASSERT_FALSE(slot.late);
        now = slot.start_ns;
    }
    EXPECT_LE(std::llabs(now - 86'400'000'000'000), 1);
}

TEST(FramePacer, LateFrameIsToldAndTheGridStays) {
    Frames frames(100.0);
    const std::int64_t origin = frames.step(kMs).start_ns;
    EXPECT_FALSE(frames.step(14 * kMs).late);
    const FramePacer::Slot late = frames.step(kMs);
    EXPECT_TRUE(late.late);
    EXPECT_EQ(late.slots, 1U);
    EXPECT_EQ(late.start_ns, origin + 24 * kMs);
    const FramePacer::Slot next = frames.step(kMs);
    EXPECT_FALSE(next.late);
    EXPECT_EQ(next.start_ns, origin + 30 * kMs);
}

TEST(FramePacer, LongStallLeavesSlotsOutInsteadOfABurst) {
    Frames frames(100.0);
    const std::int64_t origin = frames.step(kMs).start_ns;
    frames.step(995 * kMs);
    const FramePacer::Slot late = frames.step(kMs);
    EXPECT_TRUE(late.late);
    EXPECT_EQ(late.start_ns, origin + 1005 * kMs);
    EXPECT_EQ(late.slots, 99U);
    const FramePacer::Slot next = frames.step(kMs);
    EXPECT_EQ(next.start_ns, origin + 1010 * kMs);
    EXPECT_EQ(next.slots, 1U);
}

TEST(FramePacer, SlotsAddUpToTheTimeThatPassed) {
    Frames frames(100.0);
    const std::int64_t origin = frames.step(0).start_ns;
    std::uint64_t slots = 0;
    std::uint64_t late = 0;
    for (int i = 0; i < 1000; ++i) {
        const FramePacer::Slot slot = frames.step(13 * kMs);
        slots += slot.slots;
        late += slot.late ? 1 : 0;
    }
    // Frames of 13 ms on a 10 ms grid run back to back: no slot is waited for, and none is lost from the sum.
    const std::int64_t elapsed_ns = frames.now_ns() - origin - 13 * kMs;
    EXPECT_NEAR(static_cast<double>(slots) * 10.0, static_cast<double>(elapsed_ns) * 1e-6, 10.0);
    EXPECT_EQ(late, 999U);
}

}  // namespace
}  // namespace skyig::server
