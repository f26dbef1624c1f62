// What the frame loop hands over is in the file, and costs it neither memory nor time.
#include "server/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "protocol/recording/capture_reader.h"
#include "server/replay.h"
#include "tests/server/loop/recording_fixture.h"
#include "tests/support/allocation_count.h"

namespace skyig::server {
namespace {

using namespace tests;
using protocol::recording::CapturedPacket;
using protocol::recording::CaptureReader;
using protocol::transport::Datagram;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

protocol::CanFrame can_frame(std::uint32_t id, std::int64_t time_ns) {
    protocol::CanFrame frame;
    frame.received_ns = time_ns;
    frame.id = id;
    frame.length = 2;
    frame.data = {1, 2};
    return frame;
}

TEST(Recorder, WritesWhatAnyReaderUnderstands) {
    const Scratch scratch;
    const config::Config config = rig();
    const std::string path = scratch.file("a.pcapng");
    {
        Recorder recorder(path, config, facts(config));
        recorder.mark({7, 1, 5, kStartNs}, bytes_of("answer"));
        recorder.datagram(0, {kHost, kStartNs + 5, bytes_of("host")});
        recorder.datagram(1, {kInstructor, kStartNs + 6, bytes_of("instructor")});
        recorder.can_frame(3, can_frame(0x123, kStartNs + 7));
        recorder.finish();
        EXPECT_EQ(recorder.counts().written, 4U);
        EXPECT_EQ(recorder.counts().lost, 0U);
        EXPECT_FALSE(recorder.counts().file_failed);
    }
    auto reader = CaptureReader::open(path).value();
    EXPECT_THAT(std::string(reader.section_comment()), HasSubstr("renderer llvmpipe test"));
    const CapturedPacket* packet = reader.next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->comment, "frame 7 slots 1 thinned 5");
    ASSERT_TRUE(Replay::mark_of(*packet));
    EXPECT_EQ(Replay::mark_of(*packet)->thinned, 5U);
    EXPECT_EQ(packet->time_ns, kStartNs);
    EXPECT_EQ(packet->from.port, 8004);
    packet = reader.next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->from, kHost);
    EXPECT_EQ(packet->to.port, 8004);
    EXPECT_EQ(packet->time_ns, kStartNs + 5);
    EXPECT_EQ(packet->payload.size(), 4U);
    packet = reader.next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->to.port, 8010);
    packet = reader.next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->kind, CapturedPacket::Kind::kCan);
    EXPECT_EQ(reader.interface_of_last().name, "can1");
    EXPECT_EQ(packet->can.id, 0x123U);
    EXPECT_EQ(packet->can.bytes().size(), 2U);
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(reader.end(), CaptureReader::End::kComplete);
}

TEST(Recorder, CostsItsCallerNeitherMemoryNorWaiting) {
    const Scratch scratch;
    const config::Config config = rig();
    Recorder recorder(scratch.file("a.pcapng"), config, facts(config));
    const std::vector<std::byte> message(200);
    const protocol::CanFrame frame = can_frame(0x321, kStartNs);
    constexpr int kFrames = 2000;
    const auto allocations = skyig::tests::allocation_count_of_this_thread();
    const auto before = std::chrono::steady_clock::now();
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        recorder.mark({i, 1, 0, kStartNs}, message);
        recorder.datagram(0, {kHost, kStartNs, message});
        recorder.can_frame(2, frame);
    }
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - before;
    EXPECT_EQ(skyig::tests::allocation_count_of_this_thread(), allocations);
    const double each_ns = took.count() / (3 * kFrames);
    std::printf("a packet handed to the recorder takes %.0f ns of the frame loop\n", each_ns);
    // A 60 Hz host and a bus of 1 kHz are 1100 packets a second: within a hundredth of 2 % of a core.
    EXPECT_LT(each_ns, 20'000.0);
    recorder.finish();
    EXPECT_EQ(recorder.counts().written, 3U * kFrames);
}

TEST(Recorder, WhatDoesNotFitIsCounted) {
    const Scratch scratch;
    const config::Config config = rig();
    Recorder recorder(scratch.file("a.pcapng"), config, facts(config));
    const std::vector<std::byte> too_long(65'508);
    recorder.datagram(0, {kHost, kStartNs, too_long});
    EXPECT_EQ(recorder.counts().lost, 1U);
    // More than waits for the disk in any case: 20 MB at once.
    const std::vector<std::byte> large(60'000);
    for (int i = 0; i < 1000; ++i)
        recorder.datagram(0, {kHost, kStartNs, large});
    recorder.finish();
    const Recorder::Counts counts = recorder.counts();
    std::printf("of 1001 datagrams %llu are written, %llu lost\n",
                static_cast<unsigned long long>(counts.written),
                static_cast<unsigned long long>(counts.lost));
    EXPECT_EQ(counts.written + counts.lost, 1001U);
    EXPECT_GE(counts.lost, 1U);
}

TEST(Recorder, FileThatCannotBeHadIsOneLine) {
    const config::Config config = rig();
    try {
        const Recorder recorder("no/such/place/a.pcapng", config, facts(config));
        FAIL() << "a recorder without a file";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(),
                     "no/such/place/a.pcapng: cannot be made for a recording: No such file or directory");
    }
}

TEST(Recorder, FullDiskEndsTheRecordingNotTheRun) {
    const config::Config config = rig();
    Recorder recorder("/dev/full", config, facts(config));
    recorder.datagram(0, {kHost, kStartNs, bytes_of("lost")});
    recorder.finish();
    EXPECT_TRUE(recorder.counts().file_failed);
}

TEST(RecordingWire, HandsOnAndWritesDownTheSame) {
    class OneDatagram final : public Wire {
      public:
        void open_frame(const FrameMark&, std::span<const std::byte>) override { ++opened; }
        void drain(ArrivalTaker& taker) override {
            taker.take(1, Datagram{kInstructor, kStartNs, bytes_of("fog")});
            taker.take(2, can_frame(0x7, kStartNs));
        }
        bool send(std::size_t, const protocol::transport::Endpoint&, std::span<const std::byte>) override {
            ++sent;
            return true;
        }
        [[nodiscard]] protocol::transport::UdpCounters counters() const override { return {.received = 5}; }
        int opened = 0;
        int sent = 0;
    };
    const Scratch scratch;
    const config::Config config = rig();
    OneDatagram inner;
    Recorder recorder(scratch.file("a.pcapng"), config, facts(config));
    RecordingWire wire(inner, recorder);
    wire.open_frame({1, 0, 0, kStartNs}, {});
    Words live;
    wire.drain(live);
    EXPECT_TRUE(wire.send(0, kHost, {}));
    EXPECT_EQ(wire.counters().received, 5U);
    EXPECT_EQ(inner.opened, 1);
    EXPECT_EQ(inner.sent, 1);
    EXPECT_THAT(live.heard, ElementsAre("1 127.0.0.1:9001 fog", "2 can 7:2"));
    recorder.finish();
    Replay replay(recorder.path(), config);
    const auto frames = frames_of(replay);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].second, live.heard);
}

}  // namespace
}  // namespace skyig::server
