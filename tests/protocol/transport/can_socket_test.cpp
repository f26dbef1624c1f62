// What needs no CAN bus: the ring, and what a kernel without CAN says. tests/can holds the rest.
#include "protocol/transport/can_socket.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <vector>

#include "protocol/transport/file_descriptor.h"

namespace skyig::protocol::transport {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

CanFrame numbered(std::uint32_t number) {
    CanFrame frame;
    frame.id = number & kMaxStandardId;
    frame.received_ns = number;
    frame.length = 1;
    frame.data[0] = static_cast<std::uint8_t>(number);
    return frame;
}

TEST(CanRing, CapacityIsTheNextPowerOfTwoAndAFullBusFitsForTwoSeconds) {
    EXPECT_EQ(CanRing(0).capacity_frames(), 64U);
    EXPECT_EQ(CanRing(65).capacity_frames(), 128U);
    EXPECT_GE(CanRing(CanOptions{}.ring_frames).capacity_frames(), 2U * 8000U);
}

TEST(CanRing, KeepsOrderAndRefusesWhenFull) {
    CanRing ring(64);
    EXPECT_TRUE(ring.empty());
    std::uint32_t next = 0;
    std::int64_t expected = 0;
    for (int round = 0; round < 5; ++round) {
        while (ring.push(numbered(next)))
            ++next;
        EXPECT_FALSE(ring.empty());
        // One part first, so that the next round wraps at another place.
        const auto check = [&expected](const CanFrame& frame) {
            EXPECT_EQ(frame, numbered(static_cast<std::uint32_t>(expected++)));
        };
        EXPECT_EQ(ring.drain(check, 40), 40U);
    }
    EXPECT_EQ(next, 64U + 4U * 40U);
}

TEST(CanRing, TwoThreadsLoseAndChangeNothing) {
    constexpr std::uint32_t kFrames = 200'000;
    CanRing ring(256);
    std::thread producer([&ring] {
        for (std::uint32_t i = 0; i < kFrames; ++i)
            while (!ring.push(numbered(i)))
                std::this_thread::yield();
    });
    std::uint32_t taken = 0;
    std::uint32_t wrong = 0;
    while (taken < kFrames) {
        const std::size_t some = ring.drain([&taken, &wrong](const CanFrame& frame) {
            if (frame != numbered(taken++)) ++wrong;
        });
        if (some == 0) std::this_thread::yield();
    }
    producer.join();
    EXPECT_EQ(wrong, 0U);
    EXPECT_TRUE(ring.empty());
}

TEST(CanReceiver, OptionsThatMakeNoSenseAreAnErrorOnAnyKernel) {
    const auto without_name = CanReceiver::open({});
    ASSERT_FALSE(without_name);
    EXPECT_THAT(without_name.error(), HasSubstr("1..15 characters"));
    CanOptions options;
    options.interface = "an_interface_too_long";
    EXPECT_FALSE(CanReceiver::open(options));
    options.interface = "can0";
    options.filters.resize(kMaxCanFilters + 1);
    const auto many = CanReceiver::open(options);
    ASSERT_FALSE(many);
    EXPECT_THAT(many.error(), HasSubstr("513 filters"));
}

TEST(CanReceiver, AKernelWithoutCanIsOneLineAndOneWithItWaits) {
    const FileDescriptor probe(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
    const int error = probe ? 0 : errno;
    CanOptions options;
    options.interface = "no_such_can";
    const auto start = std::chrono::steady_clock::now();
    const auto opened = CanReceiver::open(options);
    std::printf("errno of this kernel: %d; said: %s\n", error, opened ? "nothing" : opened.error().c_str());
    if (error == EAFNOSUPPORT) {
        ASSERT_FALSE(opened);
        EXPECT_THAT(opened.error(), HasSubstr("can no_such_can: this kernel has no CAN; load its module"));
    } else if (error == EPROTONOSUPPORT) {
        ASSERT_FALSE(opened);
        EXPECT_THAT(opened.error(), HasSubstr("modprobe can-raw"));
    } else if (error == 0) {
        ASSERT_TRUE(opened) << opened.error();
        EXPECT_EQ(opened->state(), CanState::kMissing);
        EXPECT_EQ(opened->counters().opened, 0U);
    } else {
        ASSERT_FALSE(opened);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(500));
}

}  // namespace
}  // namespace skyig::protocol::transport
