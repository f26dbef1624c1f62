#include "protocol/transport/datagram_ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>
#include <vector>

namespace skyig::protocol::transport {
namespace {

/// Bytes that tell their own number and length.
std::vector<std::byte> numbered(std::uint32_t number, std::size_t size) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = static_cast<std::byte>(number + i);
    return bytes;
}

bool is_numbered(std::span<const std::byte> bytes, std::uint32_t number) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] != static_cast<std::byte>(number + i)) return false;
    }
    return true;
}

TEST(DatagramRing, GivesBackWhatWasPutInInOrder) {
    DatagramRing ring(1);
    EXPECT_EQ(ring.capacity_bytes(), 256U << 10U);
    EXPECT_TRUE(ring.empty());
    for (std::uint32_t i = 0; i < 5; ++i) {
        const auto bytes = numbered(i, i);
        EXPECT_TRUE(ring.push({{i, static_cast<std::uint16_t>(i)}, i, bytes}));
    }
    std::uint32_t next = 0;
    EXPECT_EQ(ring.drain([&next](const Datagram& datagram) {
        EXPECT_EQ(datagram.from, (Endpoint{next, static_cast<std::uint16_t>(next)}));
        EXPECT_EQ(datagram.arrival_ns, next);
        EXPECT_EQ(datagram.bytes.size(), next);
        EXPECT_TRUE(is_numbered(datagram.bytes, next));
        ++next;
    }),
              5U);
    EXPECT_TRUE(ring.empty());
}

TEST(DatagramRing, LeavesTheRestOfAFloodForTheNextTime) {
    DatagramRing ring(256 << 10U);
    const auto bytes = numbered(0, 1000);
    for (int i = 0; i < 100; ++i)
        ASSERT_TRUE(ring.push({{}, i, bytes}));
    std::int64_t next = 0;
    const auto take = [&next](const Datagram& datagram) { EXPECT_EQ(datagram.arrival_ns, next++); };
    EXPECT_EQ(ring.drain(take, 10000), 10U);
    EXPECT_FALSE(ring.empty());
    EXPECT_EQ(ring.drain(take), 90U);
    EXPECT_TRUE(ring.empty());
}

TEST(DatagramRing, RefusesWhatDoesNotFitAndLosesNothingElse) {
    DatagramRing ring(256 << 10U);
    const auto large = numbered(0, 65507);
    int held = 0;
    while (ring.push({{}, held, large}))
        ++held;
    EXPECT_EQ(held, 4);
    EXPECT_FALSE(ring.push({{}, 0, large}));
    std::vector<std::int64_t> order;
    ring.drain([&order](const Datagram& datagram) { order.push_back(datagram.arrival_ns); });
    EXPECT_EQ(order, (std::vector<std::int64_t>{0, 1, 2, 3}));
    EXPECT_TRUE(ring.push({{}, 0, large}));
}

TEST(DatagramRing, KeepsEachDatagramInOnePieceAcrossItsEnd) {
    DatagramRing ring(1);
    std::mt19937 random(7);
    std::uint32_t pushed = 0;
    std::uint32_t taken = 0;
    for (int round = 0; round < 20'000; ++round) {
        const std::size_t size = random() % 8 == 0 ? random() % 65508 : random() % 300;
        if (ring.push({{}, static_cast<std::int64_t>(size), numbered(pushed, size)})) ++pushed;
        if (random() % 3 == 0) {
            ring.drain([&taken](const Datagram& datagram) {
                EXPECT_EQ(datagram.bytes.size(), static_cast<std::size_t>(datagram.arrival_ns));
                EXPECT_TRUE(is_numbered(datagram.bytes, taken));
                ++taken;
            });
        }
    }
    ring.drain([&taken](const Datagram& /*datagram*/) { ++taken; });
    EXPECT_EQ(taken, pushed);
}

TEST(DatagramRing, CarriesEverythingBetweenTwoThreads) {
    constexpr std::uint32_t kDatagrams = 200'000;
    DatagramRing ring(1);
    std::thread producer([&ring] {
        std::vector<std::byte> bytes(300);
        for (std::uint32_t i = 0; i < kDatagrams; ++i) {
            const std::size_t size = 4 + i % 290;
            std::memcpy(bytes.data(), &i, sizeof(i));
            while (!ring.push({{}, i, std::span(bytes).first(size)}))
                std::this_thread::yield();
        }
    });
    std::uint32_t next = 0;
    std::uint32_t wrong = 0;
    while (next < kDatagrams) {
        ring.drain([&](const Datagram& datagram) {
            std::uint32_t number = 0;
            std::memcpy(&number, datagram.bytes.data(), sizeof(number));
            if (number != next || datagram.bytes.size() != 4 + next % 290) ++wrong;
            ++next;
        });
        std::this_thread::yield();
    }
    producer.join();
    EXPECT_EQ(wrong, 0U);
}

}  // namespace
}  // namespace skyig::protocol::transport
