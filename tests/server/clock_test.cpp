#include "server/clock.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace skyig::server {
namespace {

TEST(ManualClock, MovesOnlyByHandOrBySleeping) {
    ManualClock clock(1'000, 5'000'000);
    EXPECT_EQ(clock.monotonic_ns(), 1'000);
    EXPECT_EQ(clock.utc_ns(), 5'000'000);
    clock.advance_ns(500);
    EXPECT_EQ(clock.monotonic_ns(), 1'500);
    EXPECT_EQ(clock.utc_ns(), 5'000'500);
    clock.sleep_until_ns(2'000);
    EXPECT_EQ(clock.monotonic_ns(), 2'000);
    clock.sleep_until_ns(1'000);
    EXPECT_EQ(clock.monotonic_ns(), 2'000);
}

TEST(SystemClock, SleepsUntilTheDeadlineAndNeverGoesBack) {
    SystemClock clock;
    const std::int64_t start_ns = clock.monotonic_ns();
    clock.sleep_until_ns(start_ns - 1'000'000'000);  // passed: at once
    clock.sleep_until_ns(start_ns + 5'000'000);
    const std::int64_t late_ns = clock.monotonic_ns() - (start_ns + 5'000'000);
    std::printf("  woke %.3f ms after the deadline\n", static_cast<double>(late_ns) * 1e-6);
    EXPECT_GE(late_ns, 0);
    EXPECT_LT(late_ns, 5'000'000'000);
}

TEST(SystemClock, KnowsTheDateRoughly) {
    constexpr std::int64_t k2020_ns = 1'577'836'800LL * 1'000'000'000LL;
    EXPECT_GT(SystemClock().utc_ns(), k2020_ns);
}

}  // namespace
}  // namespace skyig::server
