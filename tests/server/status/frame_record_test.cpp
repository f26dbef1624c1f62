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

FrameParts own(std::int64_t input_ms, std::int64_t shared_ms, std::int64_t channels_ms,
               std::int64_t output_ms) {
    FrameParts parts;
    parts.input_ns = input_ms * kMs;
    parts.shared_ns = shared_ms * kMs;
    parts.channels_ns = channels_ms * kMs;
    parts.output_ns = output_ms * kMs;
    return parts;
}

TEST(FrameRecord, NamesTheLongestPartAsTheCauseOfALateFrame) {
    EXPECT_EQ(late_cause(own(12, 1, 2, 1), kPeriod_s), LateCause::kInput);
    EXPECT_EQ(late_cause(own(1, 12, 2, 1), kPeriod_s), LateCause::kShared);
    EXPECT_EQ(late_cause(own(1, 5, 6, 1), kPeriod_s), LateCause::kChannels);
    EXPECT_EQ(late_cause(own(1, 5, 6, 7), kPeriod_s), LateCause::kOutput);
    FrameParts rebuilt = own(1, 12, 2, 1);
    rebuilt.rebuilt = true;
    EXPECT_EQ(late_cause(rebuilt, kPeriod_s), LateCause::kRebuild);
}

TEST(FrameRecord, WaitsAreTheCauseOfWhatWouldHaveFittedWithoutThem) {
    FrameParts parts = own(1, 1, 6, 1);
    parts.host_ns = 4 * kMs;
    EXPECT_EQ(late_cause(parts, kPeriod_s), LateCause::kHost);
    parts.display_ns = 5 * kMs;
    EXPECT_EQ(late_cause(parts, kPeriod_s), LateCause::kDisplay);
    parts.channels_ns = 9 * kMs;
    EXPECT_EQ(late_cause(parts, kPeriod_s), LateCause::kChannels);
}

TEST(FrameRecord, TheMachineIsTheCauseOfWhatTookLessProcessorTimeThanThePeriod) {
    FrameParts parts = own(1, 1, 20, 1);
    parts.processor_ns = 9 * kMs;
    EXPECT_EQ(late_cause(parts, kPeriod_s), LateCause::kMachine);
    parts.processor_ns = 11 * kMs;
    EXPECT_EQ(late_cause(parts, kPeriod_s), LateCause::kChannels);
    // Within its period: it was woken late.
    EXPECT_EQ(late_cause(own(1, 1, 6, 1), kPeriod_s), LateCause::kMachine);
}

TEST(FrameRecord, CountsALateFrameForTheOneBefore) {
    FrameRecord record;
    FrameParts parts = own(0, 15, 0, 0);
    record.add(parts, false, kPeriod_s);
    parts = own(0, 0, 1, 0);
    parts.start_ns = 15 * kMs;
    record.add(parts, true, kPeriod_s);
    parts.start_ns = 20 * kMs;
    record.add(parts, false, kPeriod_s);
    EXPECT_EQ(record.late(LateCause::kShared), 1U);
    EXPECT_EQ(record.late(LateCause::kChannels), 0U);
    EXPECT_EQ(record.recent().late, 1U);
    EXPECT_EQ(record.end_ns(), 21 * kMs);
}

TEST(FrameRecord, AChainOfLateFramesCountsForWhatBeganIt) {
    FrameRecord record;
    record.add(own(0, 0, 25, 0), false, kPeriod_s);
    for (int i = 0; i < 3; ++i)
        record.add(own(0, 8, 1, 0), true, kPeriod_s);
    EXPECT_EQ(record.late(LateCause::kChannels), 3U);
    record.add(own(0, 8, 1, 0), false, kPeriod_s);
    FrameParts waited = own(0, 1, 1, 0);
    waited.host_ns = 9 * kMs;
    record.add(waited, false, kPeriod_s);
    record.add(own(0, 1, 1, 0), true, kPeriod_s);
    EXPECT_EQ(record.late(LateCause::kHost), 1U);
}

TEST(FrameRecord, TellsTheLastFramesExactly) {
    FrameRecord record;
    EXPECT_EQ(record.recent().frames, 0U);
    std::mt19937_64 random(3);
    std::uniform_int_distribution<std::int64_t> durations(1, 9'000'000);
    std::vector<double> all_ms;
    for (std::int64_t i = 0; i < 1500; ++i) {
        const std::int64_t took_ns = durations(random);
        FrameParts parts;
        parts.start_ns = i * 10 * kMs;
        parts.channels_ns = took_ns;
        record.add(parts, false, kPeriod_s);
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
