#include "clients/bench/timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace skyig::clients::bench {
namespace {

/// A work that takes so many nanoseconds a call, times what the machine is slowed by.
Work work_of_ns(server::ManualClock& clock, double ns, const double& slowness) {
    return [&clock, &slowness, ns](std::uint64_t, std::uint64_t count) {
        clock.advance_ns(std::llround(ns * slowness * static_cast<double>(count)));
        return 1.0;
    };
}

TEST(Timing, QuartilesAreInterpolatedBetweenRanks) {
    EXPECT_EQ(quartiles({}), Quartiles());
    EXPECT_EQ(quartiles({7.0}), (Quartiles{7.0, 7.0, 7.0}));
    EXPECT_EQ(quartiles({4.0, 1.0, 3.0, 2.0}), (Quartiles{1.75, 2.5, 3.25}));
    EXPECT_EQ(quartiles({5.0, 1.0, 3.0, 2.0, 4.0}), (Quartiles{2.0, 3.0, 4.0}));
}

TEST(Timing, CostsComeOutAsNanosecondsAndFloors) {
    server::ManualClock clock;
    const double slowness = 1.0;
    const std::vector<Contender> contenders{
        {"a", "x", work_of_ns(clock, 30.0, slowness), {}},
        {"b", "x", work_of_ns(clock, 250'000.0, slowness), {}},
        {"c", "x", work_of_ns(clock, 30.0, slowness), work_of_ns(clock, 60.0, slowness)},
        {"d", "x", work_of_ns(clock, 2000.0, slowness), {}, 1, 50}};
    const PairedTimings timings =
        measure_paired(clock, work_of_ns(clock, 10.0, slowness), contenders, {5, 100'000.0});
    ASSERT_EQ(timings.contenders.size(), 4U);
    EXPECT_NEAR(timings.contenders[0].ns.median, 30.0, 1e-9);
    EXPECT_NEAR(timings.contenders[0].floors.median, 3.0, 1e-9);
    EXPECT_NEAR(timings.contenders[1].ns.median, 250'000.0, 1e-9);
    EXPECT_NEAR(timings.contenders[1].floors.median, 25'000.0, 1e-6);
    EXPECT_NEAR(timings.contenders[2].floors.median, 0.5, 1e-9) << "has a floor of its own";
    EXPECT_NEAR(timings.contenders[3].ns.median, 40.0, 1e-9) << "fifty things a call";
    EXPECT_NEAR(timings.contenders[3].floors.median, 4.0, 1e-9);
    EXPECT_NEAR(timings.floor_ns.median, 10.0, 1e-9);
}

TEST(Timing, RatiosHoldOnAMachineThatSlowsDownInBetween) {
    server::ManualClock clock;
    double slowness = 1.0;
    int batches = 0;
    // Every sixth to tenth batch the machine changes its pace.
    const auto wandering = [&](double ns) -> Work {
        return [&, ns](std::uint64_t, std::uint64_t count) {
            if (++batches % 7 == 0) slowness = slowness > 2.0 ? 1.0 : slowness * 1.7;
            clock.advance_ns(std::llround(ns * slowness * static_cast<double>(count)));
            return 1.0;
        };
    };
    const std::vector<Contender> contenders{{"a", "x", wandering(40.0), {}}, {"b", "x", wandering(80.0), {}}};
    const PairedTimings timings = measure_paired(clock, wandering(10.0), contenders, {101, 100'000.0});
    RecordProperty("a_floors", std::to_string(timings.contenders[0].floors.median));
    EXPECT_NEAR(timings.contenders[0].floors.median, 4.0, 0.01);
    EXPECT_NEAR(timings.contenders[1].floors.median, 8.0, 0.01);
}

TEST(Timing, NoCallIsMadeTwiceAndBatchesAreLongEnough) {
    server::ManualClock clock;
    std::uint64_t expected = 0;
    std::set<std::uint64_t> sizes;
    const Work work = [&](std::uint64_t first, std::uint64_t count) {
        EXPECT_EQ(first, expected);
        expected = first + count;
        sizes.insert(count);
        clock.advance_ns(static_cast<std::int64_t>(count) * 100);
        return 0.0;
    };
    const double slowness = 1.0;
    (void)measure_paired(clock, work_of_ns(clock, 10.0, slowness),
                         std::vector<Contender>{{"a", "x", work, {}}}, {3, 100'000.0});
    EXPECT_GE(*sizes.rbegin() * 100, 50'000U);
    EXPECT_LE(*sizes.rbegin() * 100, 100'000U);
}

TEST(Timing, AnExpensiveFirstCallDoesNotShortenTheBatches) {
    server::ManualClock clock;
    std::uint64_t most_calls = 0;
    const Work work = [&](std::uint64_t first, std::uint64_t count) {
        most_calls = std::max(most_calls, count);
        if (first == 0) clock.advance_ns(1'000'000);
        clock.advance_ns(static_cast<std::int64_t>(count) * 100);
        return 0.0;
    };
    const double slowness = 1.0;
    const PairedTimings timings =
        measure_paired(clock, work_of_ns(clock, 10.0, slowness), std::vector<Contender>{{"a", "x", work, {}}},
                       {3, 100'000.0});
    EXPECT_GE(most_calls, 512U);
    EXPECT_NEAR(timings.contenders[0].ns.median, 100.0, 1e-9);
}

TEST(Timing, AClockThatStandsStillLeavesNoRatioAndEnds) {
    const server::ManualClock clock;
    int calls = 0;
    const Work still = [&calls](std::uint64_t, std::uint64_t) { return ++calls, 0.0; };
    const PairedTimings timings =
        measure_paired(clock, still, std::vector<Contender>{{"a", "x", still, {}}}, {3, 100.0});
    EXPECT_EQ(timings.contenders[0].floors, Quartiles());
    EXPECT_LT(calls, 200);
}

TEST(Timing, RepeatMakesTheCallsThatWereAsked) {
    const Work work = repeat([](std::uint64_t i) { return static_cast<double>(i); });
    EXPECT_EQ(work(3, 4), 3.0 + 4.0 + 5.0 + 6.0);
    EXPECT_EQ(work(3, 0), 0.0);
}

}  // namespace
}  // namespace skyig::clients::bench
