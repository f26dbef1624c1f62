#include "server/kernel_stamps.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "server/clock.h"

namespace skyig::server {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kHour = 3'600'000 * kMs;
constexpr std::int64_t kStart = 1'780'000'000'000 * kMs;
constexpr std::int64_t kFrame = 16 * kMs;

/// A look each frame; the kernel stamps by the clock's UTC.
class KernelStampsTest : public ::testing::Test {
  protected:
    void next_frame() {
        clock_.advance_ns(kFrame);
        stamps_.look();
    }

    ManualClock clock_{5'000 * kMs, kStart};
    KernelStamps stamps_{clock_};
};

TEST_F(KernelStampsTest, AreLeftAloneWhileNobodySetsTheClock) {
    for (int i = 0; i < 10; ++i) {
        const std::int64_t stamp_ns = clock_.utc_ns() + 3 * kMs;
        next_frame();
        EXPECT_EQ(stamps_.steady_ns(stamp_ns), stamp_ns);
    }
    EXPECT_EQ(stamps_.steps(), 0U);
}

TEST_F(KernelStampsTest, RunOnWhenTheClockIsSet) {
    const std::array<std::int64_t, 8> steps{kHour,       -kHour,       40 * kMs,    -40 * kMs,
                                            1'000 * kMs, -1'000 * kMs, -kStart / 2, 20 * kMs};
    for (const std::int64_t step_ns : steps) {
        next_frame();
        const std::int64_t before = clock_.utc_ns();
        const std::int64_t steady_before = clock_.steady_utc_ns();
        clock_.advance_ns(2 * kMs);
        clock_.step_utc_ns(step_ns);
        const std::int64_t after = clock_.utc_ns();
        const std::int64_t steady_after = clock_.steady_utc_ns();
        next_frame();
        EXPECT_EQ(stamps_.last_step_ns(), step_ns);
        EXPECT_EQ(stamps_.steady_ns(before), steady_before) << step_ns;
        EXPECT_EQ(stamps_.steady_ns(after), steady_after) << step_ns;
        for (int i = 0; i < 3; ++i) {
            const std::int64_t later = clock_.utc_ns() + kMs;
            const std::int64_t steady_later = clock_.steady_utc_ns() + kMs;
            next_frame();
            EXPECT_EQ(stamps_.steady_ns(later), steady_later) << step_ns;
        }
    }
    EXPECT_EQ(stamps_.steps(), steps.size());
}

TEST_F(KernelStampsTest, OfABacklogFromBeforeTheClockWasSetAreRight) {
    next_frame();
    const std::int64_t before = clock_.utc_ns();
    const std::int64_t steady_before = clock_.steady_utc_ns();
    clock_.advance_ns(2 * kMs);
    clock_.step_utc_ns(-kHour);
    for (int i = 0; i < 20; ++i) {
        next_frame();
        EXPECT_EQ(stamps_.steady_ns(before), steady_before) << i;
    }
}

TEST_F(KernelStampsTest, FollowAClockThatIsSteered) {
    // 500 ppm, the most that a system steers by: no step, and no error that grows.
    for (int i = 0; i < 100'000; ++i) {
        clock_.step_utc_ns(kFrame / 2000);
        const std::int64_t stamp_ns = clock_.utc_ns();
        const std::int64_t steady_ns = clock_.steady_utc_ns();
        next_frame();
        ASSERT_EQ(stamps_.steady_ns(stamp_ns), steady_ns);
    }
    EXPECT_EQ(stamps_.steps(), 0U);
}

TEST_F(KernelStampsTest, WithoutAnExplanationAreTakenAsNow) {
    next_frame();
    EXPECT_EQ(stamps_.steady_ns(0), clock_.steady_utc_ns());
    EXPECT_EQ(stamps_.steady_ns(clock_.utc_ns() + kHour), clock_.steady_utc_ns());
    EXPECT_EQ(stamps_.steady_ns(clock_.utc_ns() - kHour), clock_.steady_utc_ns());
}

TEST(SystemClock, IsSteadyBesideTheSystemsUtc) {
    const SystemClock clock;
    const std::int64_t apart_ns = clock.utc_ns() - clock.steady_utc_ns();
    EXPECT_LT(apart_ns, 100 * kMs);
    EXPECT_GT(apart_ns, -100 * kMs);
    KernelStamps stamps(clock);
    stamps.look();
    EXPECT_EQ(stamps.steps(), 0U);
}

}  // namespace
}  // namespace skyig::server
