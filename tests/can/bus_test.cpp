// The receiver on a real bus of the kernel: every frame, every stamp, and interfaces that come and go.
// Runs in script/uml-can-run with vcan0 up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/transport/can_socket.h"
#include "tests/can/guest.h"
#include "tests/support/allocation_count.h"

namespace skyig::tests {
namespace {

using protocol::CanFrame;
using protocol::transport::CanCounters;
using protocol::transport::CanOptions;
using protocol::transport::CanReceiver;
using protocol::transport::CanState;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

CanReceiver opened(CanOptions options = {}) {
    if (options.interface.empty()) options.interface = kInterface;
    options.retry = milliseconds(100);
    auto receiver = CanReceiver::open(options);
    if (!receiver) throw std::runtime_error(receiver.error());
    return std::move(receiver).value();
}

std::vector<CanFrame> drained(CanReceiver& receiver) {
    std::vector<CanFrame> frames;
    receiver.drain([&frames](const CanFrame& frame) { frames.push_back(frame); });
    return frames;
}

/// Sends one frame and takes it.
void expect_it_hears(CanReceiver& receiver, std::uint32_t number) {
    TestBus bus;
    ASSERT_TRUE(bus.send_number(number));
    ASSERT_TRUE(receiver.wait(milliseconds(5000)));
    const std::vector<CanFrame> frames = drained(receiver);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].id, number & protocol::kMaxStandardId);
}

bool becomes(const CanReceiver& receiver, CanState state) {
    return eventually([&receiver, state] { return receiver.state() == state; });
}

std::string read_file(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// Sockets that hear error frames; the kernel enters that last of what a socket listens to.
std::size_t listeners() {
    const std::string list = read_file("/proc/net/can/rcvlist_err");
    std::size_t count = 0;
    for (std::size_t at = list.find(" raw"); at != std::string::npos; at = list.find(" raw", at + 1))
        ++count;
    return count;
}

/// Of every kind: the golden frames, remote, CAN FD, errors, empty.
std::string every_kind_of_frame() {
    return read_file(SKYIG_TEST_DATA "/canaerospace/canaerospace_golden.log") +
           "(1718994600.090000) can0 123#R4\n"
           "(1718994600.091000) can0 1ABCDEF0#R\n"
           "(1718994600.092000) can0 123##5001122\n"
           "(1718994600.093000) can0 00000123##4" +
           std::string(128, '5') +
           "\n"
           "(1718994600.094000) can0 20000004#0001000000000000\n"
           "(1718994600.095000) can0 7FF#\n"
           "(1718994600.096000) can0 1FFFFFFF#FFFFFFFFFFFFFFFF\n"
           "(1718994600.097000) can0 00000137#0102\n";
}

TEST(Bus, APlayedLogArrivesFrameByFrameWithTheStampsThatCandumpSees) {
    const std::string log = every_kind_of_frame();
    const std::vector<CanFrame> sent = frames_of_log(log);
    const auto directory = std::filesystem::temp_directory_path();
    const std::string played = directory / "played.log";
    const std::string dumped = directory / "dumped.log";
    std::ofstream(played) << log;

    CanReceiver receiver = opened({.bus = 3});
    // Error frames are dumped only when asked for.
    std::thread witness([&] {
        shell("exec candump -L vcan0,0:0,#FFFFFFFF -n " + std::to_string(sent.size()) + " -T 8000 >" +
              dumped);
    });
    EXPECT_TRUE(eventually([] { return listeners() == 2; }));
    shell("canplayer -I " + played + " vcan0=can0");
    witness.join();
    ASSERT_TRUE(eventually([&] { return receiver.counters().received >= sent.size(); }));

    const std::vector<CanFrame> received = drained(receiver);
    const std::vector<CanFrame> witnessed = frames_of_log(read_file(dumped));
    ASSERT_EQ(received.size(), sent.size());
    ASSERT_EQ(witnessed.size(), sent.size());
    std::int64_t worst_interval_ns = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        CanFrame expected = sent[i];
        expected.bus = 3;
        expected.received_ns = received[i].received_ns;
        EXPECT_EQ(received[i], expected) << "frame " << i + 1;
        // candump cuts the same kernel's stamp to microseconds.
        EXPECT_EQ(received[i].received_ns / 1000, witnessed[i].received_ns / 1000) << "frame " << i + 1;
        const std::int64_t late_ns =
            (received[i].received_ns - received[0].received_ns) - (sent[i].received_ns - sent[0].received_ns);
        worst_interval_ns = std::max(worst_interval_ns, std::abs(late_ns));
    }
    const CanCounters counters = receiver.counters();
    EXPECT_EQ(counters.fd_frames, 2U);
    EXPECT_EQ(counters.error_frames, 1U);
    EXPECT_EQ(counters.dropped + counters.ring_full + counters.errors, 0U);
    std::printf("%zu frames of a log, largest difference from the log's times %.2f ms\n", sent.size(),
                static_cast<double>(worst_interval_ns) * 1e-6);
    EXPECT_LT(worst_interval_ns, 2'000'000'000);
}

TEST(Bus, FiltersTellElevenFromTwentyNineBits) {
    CanReceiver receiver = opened({.filters = {{.id = 0x137, .mask = 0x7FF, .extended = false},
                                               {.id = 0x10000, .mask = 0x1FFF0000, .extended = true}}});
    TestBus bus;
    CanFrame frame;
    for (const auto& [id, extended] : {std::pair{0x137U, false},
                                       {0x138U, false},
                                       {0x137U, true},
                                       {0x10130U, true},
                                       {0x20130U, true},
                                       {0x137U, false}}) {
        frame.id = id;
        frame.extended = extended;
        ASSERT_TRUE(bus.send(frame));
    }
    ASSERT_TRUE(eventually([&] { return receiver.counters().received == 3; }));
    std::vector<std::uint32_t> ids;
    for (const CanFrame& one : drained(receiver))
        ids.push_back(one.id);
    EXPECT_EQ(ids, (std::vector<std::uint32_t>{0x137, 0x10130, 0x137}));
}

TEST(Bus, DownIsToldAndTheSameSocketHearsAgainAfterUp) {
    CanReceiver receiver = opened();
    EXPECT_EQ(receiver.state(), CanState::kUp);
    for (std::uint64_t round = 1; round <= 2; ++round) {
        shell("ip link set vcan0 down");
        EXPECT_TRUE(becomes(receiver, CanState::kDown));
        EXPECT_TRUE(eventually([&] { return receiver.counters().went_down == round; }));
        shell("ip link set vcan0 up");
        EXPECT_TRUE(becomes(receiver, CanState::kUp));
        expect_it_hears(receiver, 7);
    }
    EXPECT_EQ(receiver.counters().opened, 1U);
    EXPECT_EQ(receiver.counters().went_away, 0U);
    EXPECT_EQ(receiver.counters().errors, 0U);
}

TEST(Bus, OneThatIsDownAtTheStartIsHeardOnceUp) {
    shell("ip link set vcan0 down");
    CanReceiver receiver = opened();
    EXPECT_EQ(receiver.state(), CanState::kDown);
    shell("ip link set vcan0 up");
    EXPECT_TRUE(becomes(receiver, CanState::kUp));
    expect_it_hears(receiver, 8);
    EXPECT_EQ(receiver.counters().went_down, 0U);
}

TEST(Bus, DeletedAndMadeAnewIsFoundAgain) {
    CanReceiver receiver = opened();
    for (std::uint64_t round = 1; round <= 2; ++round) {
        shell("ip link del vcan0");
        EXPECT_TRUE(becomes(receiver, CanState::kMissing));
        EXPECT_TRUE(eventually([&] { return receiver.counters().went_away == round; }));
        // Long enough for several looks in vain.
        std::this_thread::sleep_for(milliseconds(350));
        shell("ip link add dev vcan0 type vcan && ip link set vcan0 mtu 72 up");
        EXPECT_TRUE(becomes(receiver, CanState::kUp));
        EXPECT_EQ(receiver.counters().opened, round + 1);
        expect_it_hears(receiver, 9);
    }
    EXPECT_EQ(receiver.counters().errors, 0U);
}

TEST(Bus, ReplacedWithoutALookBetweenIsFoundAgain) {
    CanReceiver receiver = opened();
    shell("ip link del vcan0 && ip link add dev vcan0 type vcan && ip link set vcan0 mtu 72 up");
    EXPECT_TRUE(eventually([&] { return receiver.counters().opened == 2; }));
    EXPECT_TRUE(becomes(receiver, CanState::kUp));
    expect_it_hears(receiver, 10);
}

TEST(Bus, OneThatComesLateIsFoundAndAnotherKindOfInterfaceIsNone) {
    CanReceiver loopback = opened({.interface = "lo"});
    CanReceiver late = opened({.interface = "vcan7"});
    EXPECT_EQ(late.state(), CanState::kMissing);
    std::this_thread::sleep_for(milliseconds(250));
    shell("ip link add dev vcan7 type vcan && ip link set vcan7 up");
    EXPECT_TRUE(becomes(late, CanState::kUp));
    TestBus bus("vcan7");
    ASSERT_TRUE(bus.send_number(1));
    EXPECT_TRUE(late.wait(milliseconds(5000)));
    shell("ip link del vcan7");
    EXPECT_TRUE(becomes(late, CanState::kMissing));
    EXPECT_EQ(loopback.state(), CanState::kMissing);
    EXPECT_EQ(loopback.counters().opened, 0U);
    EXPECT_EQ(loopback.counters().errors, 0U);
}

/// Its thread runs only when nobody else wants the processor: threads begin with the policy of who makes
/// them.
CanReceiver opened_lazy(const CanOptions& options) {
    const sched_param none{0};
    EXPECT_EQ(sched_setscheduler(0, SCHED_IDLE, &none), 0);
    CanReceiver receiver = opened(options);
    EXPECT_EQ(sched_setscheduler(0, SCHED_OTHER, &none), 0);
    return receiver;
}

TEST(Bus, AQueueOverrunIsCountedToTheFrame) {
    constexpr std::uint32_t kSent = 30'000;
    CanReceiver receiver = opened_lazy({.ring_frames = std::size_t{1} << 15U});
    TestBus bus;
    std::uint32_t sent = 0;
    while (sent < kSent)
        ASSERT_TRUE(bus.send_number(sent++));
    const auto counted = [&receiver] {
        const CanCounters now = receiver.counters();
        return now.received + now.dropped;
    };
    // The count of the lost comes with the next frame that is queued.
    EXPECT_TRUE(eventually([&] {
        bus.send_number(sent++);
        std::this_thread::sleep_for(milliseconds(200));
        return counted() >= kSent;
    }));
    EXPECT_EQ(counted(), sent);
    const CanCounters counters = receiver.counters();
    std::printf("%u frames sent at once: %llu queued and read, %llu dropped and counted\n", sent,
                static_cast<unsigned long long>(counters.received),
                static_cast<unsigned long long>(counters.dropped));
    EXPECT_EQ(counters.ring_full, 0U);
    EXPECT_GT(counters.dropped, 0U);
    // A second of a full bus waits in the queue without loss.
    EXPECT_GT(counters.received, 8000U);
}

TEST(Bus, AConsumerThatIsTooSlowIsCounted) {
    CanReceiver receiver = opened({.ring_frames = 64});
    TestBus bus;
    for (std::uint32_t i = 0; i < 100; ++i)
        ASSERT_TRUE(bus.send_number(i));
    EXPECT_TRUE(eventually([&] { return receiver.counters().ring_full == 36; }));
    const std::vector<CanFrame> frames = drained(receiver);
    ASSERT_EQ(frames.size(), 64U);
    EXPECT_EQ(frames.back().data[0], 63);
    expect_it_hears(receiver, 100);
}

TEST(Bus, FramesCostNoMemoryAndTheEndIsPrompt) {
    constexpr std::uint32_t kFrames = 4000;
    auto receiver = std::make_unique<CanReceiver>(opened());
    TestBus bus;
    std::uint32_t next = 0;
    std::uint32_t wrong = 0;
    const auto take = [&next, &wrong](const CanFrame& frame) {
        if (frame.data != numbered_frame(next++).data) ++wrong;
    };
    const std::uint64_t before = allocation_count();
    const auto start = Clock::now();
    for (std::uint32_t i = 0; i < kFrames; ++i) {
        // A loaded machine's bus has no room now and then.
        while (!bus.send_number(i))
            std::this_thread::yield();
        receiver->drain(take);
    }
    while (next < kFrames && receiver->wait(milliseconds(2000)))
        receiver->drain(take);
    const double took_s = std::chrono::duration<double>(Clock::now() - start).count();
    EXPECT_EQ(allocation_count() - before, 0U);
    EXPECT_EQ(next, kFrames);
    EXPECT_EQ(wrong, 0U);
    std::printf("%.0f frames/s sent, received and drained on the guest's one processor\n", kFrames / took_s);

    const auto end = Clock::now();
    receiver.reset();
    const auto stopped_in = std::chrono::duration_cast<milliseconds>(Clock::now() - end);
    std::printf("stopped in %lld ms\n", static_cast<long long>(stopped_in.count()));
    EXPECT_LT(stopped_in, milliseconds(500));
}

}  // namespace
}  // namespace skyig::tests
