// Real sockets on the loopback; every operator new is counted, so that the steady path can be held to none.
#include "protocol/transport/udp.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "tests/support/allocation_count.h"

namespace skyig::protocol::transport {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr Endpoint kLoopback{0x7F000001, 0};
constexpr milliseconds kPatience{2000};

UdpReceiver opened(const UdpOptions& options) {
    auto receiver = UdpReceiver::open(options);
    EXPECT_TRUE(receiver) << receiver.error();
    return std::move(receiver).value();
}

UdpSender sender() {
    auto made = UdpSender::open();
    EXPECT_TRUE(made) << made.error();
    return std::move(made).value();
}

std::int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

/// Until `done` or patience ends.
template <class Done>
bool eventually(Done done) {
    const auto end = Clock::now() + kPatience;
    while (!done()) {
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
}

TEST(Udp, ADatagramArrivesWithSenderAndKernelStamp) {
    UdpReceiver receiver = opened({.listen = kLoopback});
    EXPECT_NE(receiver.local().port, 0);
    UdpSender host = sender();
    const std::array<std::byte, 3> sent{std::byte{1}, std::byte{2}, std::byte{3}};
    const std::int64_t before = now_ns();
    ASSERT_TRUE(host.send(receiver.local(), sent));
    ASSERT_TRUE(receiver.wait(kPatience));
    const std::int64_t after = now_ns();
    std::int64_t arrival = 0;
    Endpoint from;
    EXPECT_EQ(receiver.drain([&](const Datagram& datagram) {
        EXPECT_TRUE(std::equal(sent.begin(), sent.end(), datagram.bytes.begin(), datagram.bytes.end()));
        arrival = datagram.arrival_ns;
        from = datagram.from;
    }),
              1U);
    EXPECT_EQ(from.address, kLoopback.address);
    EXPECT_NE(from.port, 0);
    // The kernel's stamp lies between the two looks at the clock, up to the clock's own grain.
    EXPECT_GE(arrival, before - 5'000'000);
    EXPECT_LE(arrival, after + 5'000'000);
    std::printf("sent to stamp %.1f us, sent to drained %.1f us\n",
                static_cast<double>(arrival - before) * 1e-3, static_cast<double>(after - before) * 1e-3);
    EXPECT_EQ(receiver.counters().received, 1U);
    EXPECT_EQ(receiver.counters().received_bytes, 3U);
    EXPECT_EQ(host.sent(), 1U);
}

TEST(Udp, AnAnswerComesFromTheListeningPort) {
    UdpReceiver ig = opened({.listen = kLoopback});
    UdpReceiver host = opened({.listen = kLoopback});
    auto answer = ig.make_sender();
    ASSERT_TRUE(answer);
    ASSERT_TRUE(answer->send(host.local(), std::array{std::byte{9}}));
    ASSERT_TRUE(host.wait(kPatience));
    Endpoint from;
    host.drain([&from](const Datagram& datagram) { from = datagram.from; });
    EXPECT_EQ(from, ig.local());
}

TEST(Udp, TheLargestAndTheEmptyDatagramArriveWhole) {
    UdpReceiver receiver = opened({.listen = kLoopback});
    UdpSender host = sender();
    std::vector<std::byte> large(65507);
    for (std::size_t i = 0; i < large.size(); ++i)
        large[i] = static_cast<std::byte>(i * 7);
    ASSERT_TRUE(host.send(receiver.local(), large));
    ASSERT_TRUE(host.send(receiver.local(), {}));
    ASSERT_TRUE(eventually([&] { return receiver.counters().received == 2; }));
    std::vector<std::size_t> sizes;
    receiver.drain([&](const Datagram& datagram) {
        sizes.push_back(datagram.bytes.size());
        if (!datagram.bytes.empty()) {
            EXPECT_TRUE(std::equal(large.begin(), large.end(), datagram.bytes.begin(), datagram.bytes.end()));
        }
    });
    EXPECT_EQ(sizes, (std::vector<std::size_t>{65507, 0}));
}

TEST(Udp, StrangersAreCountedAndDropped) {
    UdpReceiver receiver = opened({.listen = kLoopback, .allowed = {{0x7F000002, 0}, {0x0A000001, 0}}});
    UdpSender stranger = sender();
    UdpReceiver second = opened({.listen = {0x7F000002, 0}});
    auto friendly = second.make_sender();
    ASSERT_TRUE(friendly);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(stranger.send(receiver.local(), std::array{std::byte{1}}));
    EXPECT_TRUE(friendly->send(receiver.local(), std::array{std::byte{2}}));
    ASSERT_TRUE(eventually([&] { return receiver.counters().received == 1; }));
    EXPECT_TRUE(eventually([&] { return receiver.counters().not_allowed == 3; }));
    EXPECT_EQ(receiver.drain([](const Datagram& datagram) { EXPECT_EQ(datagram.bytes[0], std::byte{2}); }),
              1U);
}

TEST(Udp, AFullRingIsCountedAndTheRestGoesOn) {
    UdpReceiver receiver = opened({.listen = kLoopback, .ring_bytes = 1});
    UdpSender host = sender();
    const std::vector<std::byte> large(60'000);
    for (std::uint64_t i = 1; i <= 8; ++i) {
        ASSERT_TRUE(host.send(receiver.local(), large));
        ASSERT_TRUE(
            eventually([&] { return receiver.counters().received + receiver.counters().ring_full == i; }));
    }
    EXPECT_EQ(receiver.counters().ring_full, 4U);
    EXPECT_EQ(receiver.drain([](const Datagram&) {}), 4U);
    ASSERT_TRUE(host.send(receiver.local(), large));
    EXPECT_TRUE(receiver.wait(kPatience));
    EXPECT_EQ(receiver.drain([](const Datagram&) {}), 1U);
}

TEST(Udp, ABusyPortIsSaidInOneLine) {
    const UdpReceiver first = opened({.listen = kLoopback});
    const auto second = UdpReceiver::open({.listen = first.local()});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error(),
              "udp " + to_string(first.local()) +
                  ": address already in use; stop the other program or choose another listen port");
}

TEST(Udp, AnAddressOfAnotherMachineIsSaidInOneLine) {
    const auto receiver =
        UdpReceiver::open({.listen = {0xC0000201, 8004}});  // 192.0.2.1 is for documentation
    ASSERT_FALSE(receiver);
    EXPECT_NE(receiver.error().find("192.0.2.1:8004: this machine has no such address"), std::string::npos)
        << receiver.error();
}

TEST(Udp, AFailedSendIsCounted) {
    UdpSender host = sender();
    EXPECT_FALSE(host.send({kLoopback.address, 9}, std::vector<std::byte>(65508)));
    EXPECT_EQ(host.failed(), 1U);
    EXPECT_EQ(host.sent(), 0U);
}

TEST(Udp, WaitingEndsWithItsTimeWhenNothingComes) {
    UdpReceiver receiver = opened({.listen = kLoopback});
    const auto begin = Clock::now();
    EXPECT_FALSE(receiver.wait(milliseconds(30)));
    EXPECT_GE(Clock::now() - begin, milliseconds(25));
}

TEST(Udp, ClosingIsPromptAndFreesThePort) {
    auto receiver = std::make_unique<UdpReceiver>(opened({.listen = kLoopback}));
    const Endpoint local = receiver->local();
    const auto begin = Clock::now();
    receiver.reset();
    const std::chrono::duration<double, std::milli> took = Clock::now() - begin;
    std::printf("closed in %.2f ms\n", took.count());
    EXPECT_LT(took.count(), 500.0);
    EXPECT_TRUE(UdpReceiver::open({.listen = local}));
}

TEST(Udp, SteadyReceivingAllocatesNothing) {
    UdpReceiver receiver = opened({.listen = kLoopback});
    UdpSender host = sender();
    const std::array<std::byte, 296> message{};
    std::uint64_t taken = 0;
    const auto exchange = [&] {
        EXPECT_TRUE(host.send(receiver.local(), message));
        EXPECT_TRUE(receiver.wait(kPatience));
        taken += receiver.drain([](const Datagram&) {});
    };
    exchange();
    const std::uint64_t before = skyig::tests::allocation_count();
    for (int i = 0; i < 1000; ++i)
        exchange();
    EXPECT_EQ(skyig::tests::allocation_count() - before, 0U);
    EXPECT_EQ(taken, 1001U);
}

}  // namespace
}  // namespace skyig::protocol::transport
