#include "clients/skyig/answer_statistics.h"

#include <gtest/gtest.h>

namespace skyig::clients {
namespace {

namespace cigi = protocol::cigi;

constexpr std::int64_t kMs = 1'000'000;

cigi::StartOfFrame answer(std::uint32_t ig_frame, std::uint32_t host_frame) {
    cigi::StartOfFrame start_of_frame;
    start_of_frame.ig_frame_number = ig_frame;
    start_of_frame.last_host_frame_number = host_frame;
    return start_of_frame;
}

void receive(AnswerStatistics& statistics, std::uint32_t ig_frame, std::uint32_t host_frame,
             std::int64_t at_ns) {
    statistics.received(answer(ig_frame, host_frame), cigi::Version::k33, at_ns);
}

TEST(AnswerStatistics, TellsRateAndRoundTrip) {
    AnswerStatistics statistics;
    for (std::uint32_t i = 1; i <= 100; ++i) {
        statistics.sent(i, i * 20 * kMs);
        // Echoes the message before the last one, 25 ms after it went out.
        if (i > 1) receive(statistics, i, i - 1, (i - 1) * 20 * kMs + 25 * kMs);
    }
    EXPECT_EQ(statistics.count(), 99U);
    EXPECT_EQ(statistics.lost(), 0U);
    EXPECT_NEAR(statistics.rate_hz(), 50.0, 1e-9);
    EXPECT_NEAR(statistics.round_trip().quantile_ms(0.5), 25.0, 0.13);
    EXPECT_EQ(statistics.round_trip().count(), 99U);
    EXPECT_EQ(statistics.frames_behind().quantile(0.5), 1U);
}

TEST(AnswerStatistics, CountsOnlyTheFirstAnswerThatEchoesAMessage) {
    AnswerStatistics statistics;
    statistics.sent(1, 0);
    receive(statistics, 1, 1, 10 * kMs);
    receive(statistics, 2, 1, 20 * kMs);
    receive(statistics, 3, 1, 30 * kMs);
    EXPECT_EQ(statistics.round_trip().count(), 1U);
    EXPECT_NEAR(statistics.round_trip().largest_ms(), 10.0, 1e-9);
}

TEST(AnswerStatistics, IgnoresEchoesOfAnotherHostsNumbers) {
    AnswerStatistics statistics;
    receive(statistics, 1, 0, 0);
    statistics.sent(1, 0);
    receive(statistics, 2, 6500, kMs);
    receive(statistics, 3, 0, kMs);
    EXPECT_EQ(statistics.round_trip().count(), 0U);
}

TEST(AnswerStatistics, CountsGapsOvertakenAnswersAndRestarts) {
    AnswerStatistics statistics;
    receive(statistics, 0xFFFFFFFEU, 0, 0);
    receive(statistics, 0xFFFFFFFFU, 0, kMs);
    receive(statistics, 0, 0, 2 * kMs);
    EXPECT_EQ(statistics.lost(), 0U) << "the number wraps";
    receive(statistics, 4, 0, 3 * kMs);
    EXPECT_EQ(statistics.lost(), 3U);
    receive(statistics, 2, 0, 4 * kMs);
    EXPECT_EQ(statistics.lost(), 2U) << "overtaken, not lost";
    EXPECT_EQ(statistics.last().ig_frame_number, 4U);
    EXPECT_EQ(statistics.last_at_ns(), 4 * kMs);
    EXPECT_EQ(statistics.restarts(), 0U);
    receive(statistics, 5000, 0, 5 * kMs);
    const std::uint64_t lost = statistics.lost();
    receive(statistics, 1, 0, 6 * kMs);
    EXPECT_EQ(statistics.restarts(), 1U);
    EXPECT_EQ(statistics.lost(), lost);
    EXPECT_EQ(statistics.count(), 7U);
}

}  // namespace
}  // namespace skyig::clients
