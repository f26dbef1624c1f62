#include "server/pace.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <random>

#include "server/host_timing.h"

namespace skyig::server {
namespace {

constexpr double kRate_hz = 60.0;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A display that refreshes at its own rate; the swap returns then, with some jitter.
class DisplayPaceTest : public ::testing::Test {
  protected:
    /// Draws and swaps once. \param work_s  before the swap
    FramePacer::Slot frame(double work_s, double refresh_hz) {
        const FramePacer::Slot slot = *pace_.next();
        clock_.advance_s(work_s);
        const double period_ns = 1e9 / refresh_hz;
        const auto at_ns = static_cast<double>(clock_.monotonic_ns());
        const auto next = static_cast<std::int64_t>(at_ns / period_ns) + 1;
        std::uniform_real_distribution<double> jitter_ns(0.0, 2e5);
        clock_.sleep_until_ns(
            static_cast<std::int64_t>(static_cast<double>(next) * period_ns + jitter_ns(random_)));
        return slot;
    }

    ManualClock clock_{kSecond_ns};
    DisplayPace pace_{clock_, kRate_hz};
    std::mt19937 random_{7};
};

TEST_F(DisplayPaceTest, OneFrameARefreshAndNoneLate) {
    frame(0.002, kRate_hz);
    for (int i = 0; i < 1000; ++i) {
        const FramePacer::Slot slot = frame(0.005, kRate_hz);
        EXPECT_EQ(slot.slots, 1U);
        EXPECT_FALSE(slot.late);
    }
    EXPECT_EQ(pace_.spaced(), 0U);
}

TEST_F(DisplayPaceTest, AFrameThatMissesARefreshIsLateAndTheWorldMovesOnByTwo) {
    frame(0.002, kRate_hz);
    frame(0.020, kRate_hz);
    const FramePacer::Slot slot = frame(0.005, kRate_hz);
    EXPECT_TRUE(slot.late);
    EXPECT_EQ(slot.slots, 2U);
}

TEST_F(DisplayPaceTest, TheWorldKeepsToTheClockWhereTheDisplayIsOffTheRate) {
    for (const double refresh_hz : {59.94, 60.2}) {
        const std::int64_t start_ns = clock_.monotonic_ns();
        DisplayPace pace(clock_, kRate_hz);
        std::uint64_t slots = 0;
        int uneven = 0;
        double worst_s = 0.0;
        for (int i = 0; i < 60 * 120; ++i) {
            const FramePacer::Slot slot = *pace.next();
            slots += slot.slots;
            uneven += i > 0 && slot.slots != 1 ? 1 : 0;
            const double world_s = static_cast<double>(slots) / kRate_hz;
            const double clock_s = static_cast<double>(clock_.monotonic_ns() - start_ns) * 1e-9;
            worst_s = std::max(worst_s, std::abs(world_s - clock_s));
            clock_.advance_ns(static_cast<std::int64_t>(1e9 / refresh_hz));
        }
        std::printf("at %.2f Hz for two minutes: world and clock apart %.1f ms at most, %d uneven steps\n",
                    refresh_hz, worst_s * 1e3, uneven);
        EXPECT_LT(worst_s, 1.6 / kRate_hz);
        EXPECT_LE(uneven, static_cast<int>(std::abs(refresh_hz - kRate_hz) * 120.0) + 2);
    }
}

TEST_F(DisplayPaceTest, ASwapThatDoesNotWaitLeavesTheSpacingToTheClock) {
    const std::int64_t start_ns = clock_.monotonic_ns();
    for (int i = 0; i < 120; ++i) {
        (void)pace_.next();
        clock_.advance_s(0.001);
    }
    EXPECT_NEAR(static_cast<double>(clock_.monotonic_ns() - start_ns) * 1e-9, 119.0 / kRate_hz, 0.005);
    EXPECT_EQ(pace_.spaced(), 119U);
}

TEST(HostTiming, TellsTheJitterOfAStampedHostWhateverItsClockRate) {
    HostTiming timing;
    std::mt19937 random(11);
    std::exponential_distribution<double> late_s(1.0 / 0.002);
    double mean_ms = 0.0;
    constexpr int kMessages = 6000;
    for (int i = 0; i < kMessages; ++i) {
        const double sent_s = i / kRate_hz;
        const double by_s = late_s(random);
        mean_ms += by_s * 1e3 / kMessages;
        protocol::cigi::IgControl control;
        control.timestamp_valid = true;
        // Fast by 100 ppm.
        control.timestamp = static_cast<std::uint32_t>(sent_s * 1.0001 * 1e5);
        timing.heard(control, kSecond_ns + static_cast<std::int64_t>((sent_s + by_s) * 1e9));
    }
    const double median_ms = timing.jitter().quantile_ms(0.5);
    std::printf("jitter told %.2f ms (median), of %.2f ms that were put in\n", median_ms, 0.6931 * mean_ms);
    EXPECT_NEAR(median_ms, 0.6931 * mean_ms, 0.15);
    EXPECT_NEAR(timing.interval().quantile_ms(0.5), 1e3 / kRate_hz, 1.0);
    // It was away.
    protocol::cigi::IgControl control;
    control.timestamp_valid = true;
    timing.heard(control, 500 * kSecond_ns);
    EXPECT_LT(timing.interval().largest_ms(), 100.0);
}

TEST(HostTiming, AHostWithoutStampsHasIntervalsAlone) {
    HostTiming timing;
    for (int i = 0; i < 10; ++i)
        timing.heard({}, kSecond_ns + i * 16'000'000);
    EXPECT_EQ(timing.interval().count(), 9U);
    EXPECT_EQ(timing.jitter().count(), 0U);
}

}  // namespace
}  // namespace skyig::server
