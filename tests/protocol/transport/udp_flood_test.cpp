// Floods: what a receiver's thread may take, whom the kernel filters, and that each datagram is counted.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

#include "protocol/transport/udp.h"
#include "protocol/transport/work_budget.h"

namespace skyig::protocol::transport {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr Endpoint kLoopback{0x7F000001, 0};
constexpr Ipv4 kStranger = 0x7F000002;
constexpr std::int64_t kMs = 1'000'000;
constexpr std::uint64_t kFlood = 20'000;

UdpReceiver opened(const UdpOptions& options) {
    auto receiver = UdpReceiver::open(options);
    EXPECT_TRUE(receiver) << receiver.error();
    return std::move(receiver).value();
}

UdpSender sender_of(const UdpReceiver& receiver) {
    auto made = receiver.make_sender();
    EXPECT_TRUE(made);
    return std::move(made).value();
}

std::uint64_t dropped(const UdpCounters& counters) {
    return counters.not_allowed + counters.ring_full + counters.queue_full;
}

template <class Done>
bool eventually(Done done) {
    const auto end = Clock::now() + milliseconds(5000);
    while (!done()) {
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
}

TEST(WorkBudget, LetsABurstPassAndThenAShareOfTheTime) {
    WorkBudget budget(0.1, 5 * kMs);
    EXPECT_EQ(budget.rest_ns(1000 * kMs, 70 * kMs), 0);
    EXPECT_EQ(budget.rest_ns(1004 * kMs, 74 * kMs), 0);
    // 1 ms of credit is left, 0.4 are earned, 4 spent: 2.6 short, a tenth of 26.
    EXPECT_EQ(budget.rest_ns(1008 * kMs, 78 * kMs), 26 * kMs);
    EXPECT_EQ(budget.rest_ns(1034 * kMs, 78 * kMs), 0);
    EXPECT_EQ(budget.rest_ns(1034 * kMs, 79 * kMs), 10 * kMs);
}

TEST(WorkBudget, KeepsNoMoreCreditThanABurstAndNeverStopsAWholeProcessor) {
    WorkBudget budget(0.5, 1 * kMs);
    EXPECT_EQ(budget.rest_ns(0, 0), 0);
    EXPECT_EQ(budget.rest_ns(100'000 * kMs, 2 * kMs), 2 * kMs);
    WorkBudget whole(1.0, 1 * kMs);
    EXPECT_EQ(whole.rest_ns(0, 0), 0);
    EXPECT_EQ(whole.rest_ns(1 * kMs, 900 * kMs), 0);
}

TEST(WorkBudget, OverALongFloodTheShareHolds) {
    WorkBudget budget(0.03, 5 * kMs);
    std::int64_t now_ns = 0;
    std::int64_t work_ns = 0;
    while (now_ns < 10'000 * kMs) {
        work_ns += 20'000;
        now_ns += 20'000;
        now_ns += budget.rest_ns(now_ns, work_ns);
    }
    const double share = static_cast<double>(work_ns) / static_cast<double>(now_ns);
    std::printf("10 s of flood: %.4f of a processor\n", share);
    EXPECT_NEAR(share, 0.03, 0.001);
}

TEST(UdpFlood, AThreadHeldBackLosesInTheKernelAndEachDatagramIsCounted) {
    UdpReceiver receiver = opened({.listen = kLoopback, .most_of_processor = 1e-4});
    auto host = UdpSender::open();
    ASSERT_TRUE(host);
    const std::array<std::byte, 300> message{};
    for (std::uint64_t i = 0; i < kFlood; ++i)
        ASSERT_TRUE(host->send(receiver.local(), message));
    const UdpCounters at_once = receiver.counters();
    std::printf("of %ju: %ju taken, %ju found the queue full\n", std::uintmax_t{kFlood},
                std::uintmax_t{at_once.received}, std::uintmax_t{at_once.queue_full});
    EXPECT_GT(at_once.queue_full, kFlood / 2);
    EXPECT_EQ(at_once.not_allowed, 0U);
    // What is still in the queue is neither taken nor lost.
    EXPECT_LE(at_once.received + dropped(at_once), kFlood);
    EXPECT_GE(at_once.received + dropped(at_once) + 2000, kFlood);
    const auto begin = Clock::now();
    { const UdpReceiver closing = std::move(receiver); }
    EXPECT_LT(Clock::now() - begin, milliseconds(500)) << "closing waits for a resting thread";
}

TEST(UdpFlood, StrangersAreFilteredByTheKernelAndTheHostIsHeard) {
    UdpReceiver receiver = opened({.listen = kLoopback, .allowed = {kLoopback}, .most_of_processor = 0.01});
    const UdpReceiver stranger = opened({.listen = {kStranger, 0}});
    UdpSender garbage = sender_of(stranger);
    auto host = UdpSender::open();
    ASSERT_TRUE(host);
    const std::array<std::byte, 300> message{};
    constexpr std::uint64_t kHostEvery = 1000;
    // Until the flood is seen as one the host shares the queue with it; so many have room there.
    std::uint64_t sent = 0;
    for (; sent < 300; ++sent)
        ASSERT_TRUE(garbage.send(receiver.local(), message));
    ASSERT_TRUE(eventually([&] { return receiver.counters().not_allowed == sent; }));
    std::this_thread::sleep_for(milliseconds(20));
    for (std::uint64_t i = 0; i < kFlood; ++i, ++sent) {
        ASSERT_TRUE(garbage.send(receiver.local(), message));
        if (i % kHostEvery == 0) {
            ASSERT_TRUE(host->send(receiver.local(), message));
        }
    }
    const std::uint64_t of_host = kFlood / kHostEvery;
    EXPECT_TRUE(eventually([&] { return receiver.counters().received == of_host; }));
    EXPECT_TRUE(eventually([&] { return dropped(receiver.counters()) == sent; }));
    std::printf("of %ju strangers' datagrams %ju counted as theirs\n", std::uintmax_t{sent},
                std::uintmax_t{receiver.counters().not_allowed});
    EXPECT_EQ(receiver.counters().not_allowed, sent);
}

TEST(UdpFlood, APortOfTheListIsThePortThatMaySend) {
    const UdpReceiver named = opened({.listen = kLoopback});
    UdpReceiver receiver = opened({.listen = kLoopback, .allowed = {{kStranger, 0}, named.local()}});
    UdpSender host = sender_of(named);
    auto other = UdpSender::open();
    ASSERT_TRUE(other);
    const std::array<std::byte, 8> message{};
    for (std::uint64_t i = 0; i < kFlood; ++i)
        ASSERT_TRUE(other->send(receiver.local(), message));
    EXPECT_TRUE(eventually([&] { return dropped(receiver.counters()) == kFlood; }));
    ASSERT_TRUE(host.send(receiver.local(), message));
    EXPECT_TRUE(eventually([&] { return receiver.counters().received == 1; }));
    // Once the flood is over each stranger is looked at again.
    std::this_thread::sleep_for(milliseconds(400));
    const std::uint64_t before = receiver.counters().not_allowed;
    ASSERT_TRUE(other->send(receiver.local(), message));
    EXPECT_TRUE(eventually([&] { return receiver.counters().not_allowed == before + 1; }));
    EXPECT_EQ(receiver.drain([&](const Datagram& datagram) { EXPECT_EQ(datagram.from, named.local()); }), 1U);
}

}  // namespace
}  // namespace skyig::protocol::transport
