// How frames are remembered, and how snapshots of them change hands.
#include "server/status/frame_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

#include "server/status/snapshot_exchange.h"

namespace skyig::server::status {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr double kPeriod_s = 0.01;

TEST(FrameRecord, NamesTheLongestPartAsTheCauseOfALateFrame) {
    EXPECT_EQ(late_cause({0, 12 * kMs, 1 * kMs, 2 * kMs, 1 * kMs}, kPeriod_s), LateCause::kInput);
    EXPECT_EQ(late_cause({0, 1 * kMs, 12 * kMs, 2 * kMs, 1 * kMs}, kPeriod_s), LateCause::kShared);
    EXPECT_EQ(late_cause({0, 1 * kMs, 5 * kMs, 6 * kMs, 1 * kMs}, kPeriod_s), LateCause::kChannels);
    EXPECT_EQ(late_cause({0, 1 * kMs, 5 * kMs, 6 * kMs, 7 * kMs}, kPeriod_s), LateCause::kOutput);
    EXPECT_EQ(late_cause({0, 1 * kMs, 1 * kMs, 6 * kMs, 1 * kMs}, kPeriod_s), LateCause::kStart);
}

TEST(FrameRecord, CountsALateFrameForTheOneBefore) {
    FrameRecord record;
    record.add({0, 0, 15 * kMs, 0, 0}, false, kPeriod_s);
    record.add({15 * kMs, 0, 0, 1 * kMs, 0}, true, kPeriod_s);
    record.add({20 * kMs, 0, 0, 1 * kMs, 0}, false, kPeriod_s);
    EXPECT_EQ(record.late(LateCause::kShared), 1U);
    EXPECT_EQ(record.late(LateCause::kChannels), 0U);
    EXPECT_EQ(record.recent().late, 1U);
    EXPECT_EQ(record.end_ns(), 21 * kMs);
}

TEST(FrameRecord, TellsTheLastFramesExactly) {
    FrameRecord record;
    EXPECT_EQ(record.recent().frames, 0U);
    std::mt19937_64 random(3);
    std::uniform_int_distribution<std::int64_t> durations(1, 9'000'000);
    std::vector<double> all_ms;
    for (std::int64_t i = 0; i < 1500; ++i) {
        const std::int64_t took_ns = durations(random);
        record.add({i * 10 * kMs, 0, 0, took_ns, 0}, false, kPeriod_s);
        all_ms.push_back(static_cast<double>(took_ns) * 1e-6);
    }
    std::vector<double> last(all_ms.end() - FrameRecord::kKept, all_ms.end());
    std::sort(last.begin(), last.end());
    const RecentFrames recent = record.recent();
    EXPECT_EQ(recent.frames, FrameRecord::kKept);
    EXPECT_NEAR(recent.median_ms, last[FrameRecord::kKept / 2 - 1], 1e-6);
    EXPECT_NEAR(recent.p95_ms, last[static_cast<std::size_t>(std::ceil(0.95 * FrameRecord::kKept)) - 1],
                1e-6);
    EXPECT_NEAR(recent.largest_ms, last.back(), 1e-6);
    EXPECT_NEAR(recent.rate_hz, 100.0, 1e-9);
    EXPECT_EQ(std::accumulate(record.classes().begin(), record.classes().end(), std::uint64_t{0}), 1500U);
    EXPECT_NEAR(record.sum_s(), std::accumulate(all_ms.begin(), all_ms.end(), 0.0) * 1e-3, 1e-9);
}

TEST(SnapshotExchange, GivesTheNewestOnceItIsThere) {
    const auto exchange = std::make_unique<SnapshotExchange>();
    EXPECT_EQ(exchange->newest().frames, 0U);
    for (const std::uint64_t frames : {1U, 2U, 3U}) {
        exchange->draft().frames = frames;
        exchange->publish();
    }
    EXPECT_EQ(exchange->newest().frames, 3U);
    EXPECT_EQ(exchange->newest().frames, 3U);
    exchange->draft().frames = 4;
    EXPECT_EQ(exchange->newest().frames, 3U);
    exchange->publish();
    EXPECT_EQ(exchange->newest().frames, 4U);
}

/// A writer at full speed: no snapshot is torn, none comes before an older one.
TEST(SnapshotExchange, ReaderNeverSeesHalfASnapshot) {
    const auto exchange = std::make_unique<SnapshotExchange>();
    constexpr int kWanted = 200;
    std::atomic<bool> done{false};
    std::thread writer([&exchange, &done] {
        for (std::uint64_t i = 1; !done.load(std::memory_order_relaxed); ++i) {
            Snapshot& draft = exchange->draft();
            draft.frames = i;
            draft.late_frames = i * 3;
            draft.gl_errors = i * 5;
            exchange->publish();
        }
    });
    std::uint64_t seen = 0;
    std::uint64_t faults = 0;
    for (int different = 0; different < kWanted;) {
        const Snapshot& newest = exchange->newest();
        if (newest.late_frames != newest.frames * 3 || newest.gl_errors != newest.frames * 5 ||
            newest.frames < seen)
            ++faults;
        if (newest.frames == seen) {
            std::this_thread::yield();
            continue;
        }
        ++different;
        seen = newest.frames;
    }
    done.store(true, std::memory_order_relaxed);
    writer.join();
    std::printf("  %d of %llu snapshots seen, %zu bytes each\n", kWanted,
                static_cast<unsigned long long>(seen), sizeof(Snapshot));
    EXPECT_EQ(faults, 0U);
}

}  // namespace
}  // namespace skyig::server::status
