// Steady work allocates nothing: decoding, writing and the session are run with every operator new counted.
#include <gtest/gtest.h>

#include <chrono>

#include "protocol/cigi/message.h"
#include "protocol/cigi/session.h"
#include "tests/protocol/cigi/golden.h"
#include "tests/support/allocation_count.h"

namespace skyig::protocol::cigi {
namespace {

TEST(Allocation, IsSeenByTheCounter) {
    const std::uint64_t before = skyig::tests::allocation_count();
    ::operator delete(::operator new(8));  // a plain call, which the compiler may not leave out
    EXPECT_EQ(skyig::tests::allocation_count() - before, 1U);
}

TEST(Allocation, NoneInDecodingAnsweringAndWriting) {
    constexpr int kRounds = 5'000;
    const std::vector<GoldenDatagram>& goldens = golden_datagrams();
    std::array<std::byte, 1024> buffer{};
    Counters counters;
    Session session;
    std::uint64_t packets = 0;
    const auto begin = std::chrono::steady_clock::now();
    const std::uint64_t before = skyig::tests::allocation_count();
    for (int round = 0; round < kRounds; ++round) {
        for (const GoldenDatagram& golden : goldens) {
            MessageWriter writer(buffer, golden.version, golden.order);
            const auto copy = [&](const auto& packet) {
                ++packets;
                static_cast<void>(writer.add(packet));
            };
            static_cast<void>(decode_host_message(golden.bytes, copy, counters));
            static_cast<void>(decode_ig_message(golden.bytes, copy, counters));
            session.receive({.host_frame_number = static_cast<std::uint32_t>(round)}, golden.version,
                            golden.order);
            static_cast<void>(writer.add(session.next_frame(0)));
        }
    }
    const std::uint64_t counted = skyig::tests::allocation_count() - before;
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    std::printf("%llu packets read, checked and written, %.1f ns each, %llu allocations\n",
                static_cast<unsigned long long>(packets), time.count() / static_cast<double>(packets),
                static_cast<unsigned long long>(counted));
    EXPECT_EQ(counted, 0U);
    EXPECT_GT(packets, 400'000U);
}

TEST(Allocation, CostOfOneOwnshipMessage) {
    constexpr int kRounds = 200'000;
    for (const GoldenDatagram& golden : golden_datagrams()) {
        if (golden.name.find("ownship") == std::string::npos &&
            golden.name.find("weather") == std::string::npos)
            continue;
        Counters counters;
        double sum = 0.0;
        const auto begin = std::chrono::steady_clock::now();
        for (int round = 0; round < kRounds; ++round) {
            static_cast<void>(decode_host_message(
                golden.bytes,
                [&sum](const auto& packet) {
                    if constexpr (requires { packet.lat_x; }) sum += packet.lat_x;
                },
                counters));
        }
        const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
        std::printf("%-16s %3zu bytes, %zu packets: %.0f ns a message\n", golden.name.c_str(),
                    golden.bytes.size(), golden.packets.size(), time.count() / kRounds);
        EXPECT_EQ(counters.messages, static_cast<std::uint64_t>(kRounds));
        EXPECT_LT(time.count() / kRounds, 20'000.0);  // far above any machine's figure, sanitizers included
    }
}

}  // namespace
}  // namespace skyig::protocol::cigi
